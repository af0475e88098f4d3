#include "fitter/film_search.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <map>

#include "base/executor.h"

namespace drude {

namespace {

// Enough wavelengths to tell the minima apart; all of them decide in the end.
constexpr size_t searched_wavelengths = 120;

double real_index(const FilmProblem& problem, size_t wavelength, double porosity) {
    return film_index(problem.centre(wavelength).material, porosity).n;
}

// The wave's normal component in the film over lambda, in 1/nm.
double phase_axis(const FilmProblem& problem, size_t wavelength, double porosity,
                  double sin_theta) {
    const double n = real_index(problem, wavelength, porosity);
    const double square = std::max(n * n - sin_theta * sin_theta, 0.01);
    return std::sqrt(square) / problem.groups[wavelength].wavelength_nm;
}

// cos 2Psi against x at one angle, ascending in x.
struct Trace {
    std::vector<double> x, y;

    double span() const { return x.back() - x.front(); }
};

std::vector<Trace> traces(const FilmProblem& problem, double porosity) {
    std::map<double, std::vector<std::pair<double, double>>> by_angle;
    for (size_t i = 0; i < problem.groups.size(); ++i) {
        for (const AnglePoint& point : problem.groups[i].points) {
            by_angle[point.sin_theta].push_back(
                {phase_axis(problem, i, porosity, point.sin_theta), point.direction[0]});
        }
    }
    std::vector<Trace> result;
    for (auto& [angle, points] : by_angle) {
        std::sort(points.begin(), points.end());
        // A parabola takes three of them.
        if (points.size() < 8 || !(points.back().first > points.front().first)) continue;
        Trace trace;
        for (const auto& [x, y] : points) {
            trace.x.push_back(x);
            trace.y.push_back(y);
        }
        result.push_back(std::move(trace));
    }
    return result;
}

// Takes the parabola away and multiplies by the window and by the width that each point stands for.
void prepare(Trace* trace) {
    const Eigen::Index count = static_cast<Eigen::Index>(trace->x.size());
    const double first = trace->x.front(), span = trace->span();
    Eigen::MatrixXd basis(count, 3);
    Eigen::VectorXd values(count);
    for (Eigen::Index i = 0; i < count; ++i) {
        const double t = 2 * (trace->x[static_cast<size_t>(i)] - first) / span - 1;
        basis.row(i) << 1, t, t * t;
        values(i) = trace->y[static_cast<size_t>(i)];
    }
    const Eigen::VectorXd rest = values - basis * basis.colPivHouseholderQr().solve(values);
    const size_t last = trace->x.size() - 1;
    for (size_t i = 0; i <= last; ++i) {
        const double width = trace->x[std::min(i + 1, last)] - trace->x[i > 0 ? i - 1 : 0];
        const double sine = std::sin(pi * (trace->x[i] - first) / span);
        trace->y[i] = rest(static_cast<Eigen::Index>(i)) * sine * sine * width / span;
    }
}

double finest_step(const FilmProblem& problem, double porosity) {
    // A sixteenth of the shortest wave in the film: an eighth of the distance of two minima.
    return problem.groups.front().wavelength_nm / (16 * real_index(problem, 0, porosity));
}

double chi2_of(const FilmProblem& problem, size_t stride, double thickness_nm, double porosity) {
    double sum = 0;
    std::vector<double> residuals;
    for (size_t i = 0; i < problem.groups.size(); i += stride) {
        residuals.resize(2 * problem.groups[i].points.size());
        if (!film_residuals<double>(problem, i, {thickness_nm, porosity, 0, 0, 0},
                                    residuals.data())) {
            return std::numeric_limits<double>::infinity();
        }
        const size_t used =
            static_cast<size_t>(problem.residuals_per_point()) * problem.groups[i].points.size();
        for (size_t j = 0; j < used; ++j) sum += residuals[j] * residuals[j];
    }
    return sum;
}

// Minima over a range of thickness, ends included.
void scan(const FilmProblem& problem, size_t stride, double porosity, double first, double last,
          std::vector<FilmStart>* minima) {
    const double step = finest_step(problem, porosity);
    const int steps = std::max(1, static_cast<int>(std::ceil((last - first) / step)));
    std::vector<FilmStart> line;
    for (int i = 0; i <= steps; ++i) {
        const double thickness = std::lerp(first, last, static_cast<double>(i) / steps);
        line.push_back({thickness, porosity, chi2_of(problem, stride, thickness, porosity)});
    }
    for (size_t i = 0; i < line.size(); ++i) {
        const bool left = i == 0 || line[i].chi2 <= line[i - 1].chi2;
        const bool right = i + 1 == line.size() || line[i].chi2 <= line[i + 1].chi2;
        if (left && right && std::isfinite(line[i].chi2)) minima->push_back(line[i]);
    }
}

double widest_span(const FilmProblem& problem, double porosity) {
    double span = 0;
    for (const Trace& trace : traces(problem, porosity)) span = std::max(span, trace.span());
    return span;
}

}  // namespace

std::vector<double> fringe_thicknesses(const FilmProblem& problem, double porosity,
                                       double largest_nm) {
    std::vector<Trace> lines = traces(problem, porosity);
    double span = 0;
    for (Trace& trace : lines) {
        span = std::max(span, trace.span());
        prepare(&trace);
    }
    // 2d is the frequency: `fewest_fringes` of them fill the span.
    const double first = span > 0 ? fewest_fringes / (2 * span) : largest_nm;
    if (!(first < largest_nm)) return {};
    const double step = 1 / (16 * span);
    const size_t count = static_cast<size_t>((largest_nm - first) / step) + 1;
    std::vector<double> power(count, 0.0);
    for (const Trace& trace : lines) {
        std::vector<std::complex<double>> sums(count);
        for (size_t i = 0; i < trace.x.size(); ++i) {
            const std::complex<double> turn = std::polar(1.0, 4 * pi * step * trace.x[i]);
            std::complex<double> wave = std::polar(trace.y[i], 4 * pi * first * trace.x[i]);
            for (std::complex<double>& sum : sums) {
                sum += wave;
                wave *= turn;
            }
        }
        for (size_t f = 0; f < count; ++f) power[f] += std::norm(sums[f]);
    }
    std::vector<size_t> peaks;
    for (size_t f = 0; f < count; ++f) {
        const bool left = f == 0 || power[f] > power[f - 1];
        const bool right = f + 1 == count || power[f] >= power[f + 1];
        if (left && right) peaks.push_back(f);
    }
    std::sort(peaks.begin(), peaks.end(), [&](size_t a, size_t b) {
        return power[a] != power[b] ? power[a] > power[b] : a < b;
    });
    if (peaks.size() > 3) peaks.resize(3);
    std::vector<double> thicknesses;
    for (const size_t f : peaks) thicknesses.push_back(first + step * static_cast<double>(f));
    return thicknesses;
}

std::vector<FilmStart> search_film(const FilmProblem& problem,
                                   const std::vector<double>& porosities, double largest_nm,
                                   size_t count, int threads) {
    const size_t stride = (problem.groups.size() + searched_wavelengths - 1) / searched_wavelengths;
    std::vector<std::vector<FilmStart>> found(porosities.size());
    parallel_for(porosities.size(), threads, [&](size_t i) {
        const double porosity = porosities[i];
        const double span = widest_span(problem, porosity);
        // Without a trace (single wavelengths) everything is scanned.
        const double thin = span > 0 ? 1.25 * fewest_fringes / (2 * span) : largest_nm;
        scan(problem, stride, porosity, 0, std::min(thin, largest_nm), &found[i]);
        for (const double thickness : fringe_thicknesses(problem, porosity, largest_nm)) {
            // The peak is good to 1 %, and a porosity between two that are tried moves it more.
            const double reach = std::max(0.04 * thickness, 100.0);
            scan(problem, stride, porosity, std::max(thickness - reach, 0.0),
                 std::min(thickness + reach, largest_nm), &found[i]);
        }
    });
    std::vector<FilmStart> all;
    for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
    std::stable_sort(all.begin(), all.end(),
                     [](const FilmStart& a, const FilmStart& b) { return a.chi2 < b.chi2; });
    // Starts of the same optical thickness end in the same minimum.
    const double same = problem.groups.front().wavelength_nm / 8;
    const auto optical = [&](const FilmStart& start) {
        return start.thickness_nm * real_index(problem, 0, start.porosity);
    };
    std::vector<FilmStart> chosen;
    for (const FilmStart& start : all) {
        if (chosen.size() == count) break;
        const bool known = std::any_of(chosen.begin(), chosen.end(), [&](const FilmStart& other) {
            return std::abs(optical(other) - optical(start)) < same;
        });
        if (!known) chosen.push_back(start);
    }
    return chosen;
}

}  // namespace drude
