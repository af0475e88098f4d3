// From where, and for which metals and angles, does a fit of n and k find the truth?
//
//     stability_map FOLDER [TRIALS]
//
// n from 0.02 to 10 and k from 0.02 to 15, both logarithmic in 24 steps; in each cell TRIALS (16)
// random n, k and random starts from the same ranges. Psi and Delta are exact, so that what is
// missed is missed by the procedure: one panel an estimator and set of angles. Outcomes:
//   truth      n + ik within 1e-4 of its length
//   equal      another n + ik whose chi-square is below 4 at 0.05 and 0.1 degrees: noise hides
//              which of the two it is
//   elsewhere  another minimum, reported as a fit
//   refused    with a reason
// Writes stability_map.csv (the counts) and stability_map.png (the fraction of truth; grey where
// every trial is refused) to FOLDER and prints the sums.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "base/counter_random.h"
#include "base/error.h"
#include "base/executor.h"
#include "base/files.h"
#include "base/numbers.h"
#include "fitter/point_fit.h"
#include "image/colour_map.h"
#include "image/font.h"
#include "image/image.h"
#include "image/picture.h"

namespace {

using namespace drude;

constexpr int cells = 24;
constexpr double low_n = 0.02, high_n = 10, low_k = 0.02, high_k = 15;

struct Procedure {
    std::string name;
    Estimator estimator;
    bool random_start;
};
const std::vector<Procedure> procedures = {{"psi-delta, random start", Estimator::psi_delta, true},
                                           {"psi-delta, own start", Estimator::psi_delta, false},
                                           {"rho2, random start", Estimator::rho2, true},
                                           {"rho2, own start", Estimator::rho2, false},
                                           {"inversion", Estimator::inversion, false}};
// Empty: two to six of its own for every trial, from 30 to 85 degrees.
const std::vector<std::vector<double>> angle_sets = {
    {60}, {75}, {45, 60}, {70, 75}, {45, 50, 60, 70, 75, 80}, {}};

std::string angles_name(const std::vector<double>& angles) {
    return angles.empty() ? "random" : fmt::format("{:g}", fmt::join(angles, " "));
}

// Uniform numbers of one trial.
class Uniform {
  public:
    Uniform(uint32_t panel, uint32_t cell, uint32_t trial) : key_{panel, cell}, trial_(trial) {}
    double next() { return philox({trial_, count_++, 0x73746162, 0}, key_)[0] * 0x1p-32; }

  private:
    std::array<uint32_t, 2> key_;
    uint32_t trial_, count_ = 0;
};

double logarithmic(double low, double high, double share) {
    return low * std::pow(high / low, share);
}

std::vector<double> random_angles(Uniform* random) {
    std::vector<double> angles(2 + static_cast<size_t>(5 * random->next()));
    for (double& angle : angles) angle = 30 + 55 * random->next();
    return angles;
}

struct Counts {
    int truth = 0, equal = 0, elsewhere = 0, refused = 0;
    double least_chi2 = std::numeric_limits<double>::infinity();  // of those elsewhere
    void add(const Counts& other) {
        truth += other.truth;
        equal += other.equal;
        elsewhere += other.elsewhere;
        refused += other.refused;
        least_chi2 = std::min(least_chi2, other.least_chi2);
    }
    int all() const { return truth + equal + elsewhere + refused; }
};

void run_trial(const Procedure& procedure, const std::vector<double>& angle_set, int column,
               int row, Uniform random, Counts* counts) {
    const Index truth = {logarithmic(low_n, high_n, (column + random.next()) / cells),
                         logarithmic(low_k, high_k, (row + random.next()) / cells)};
    const Index start = {logarithmic(low_n, high_n, random.next()),
                         logarithmic(low_k, high_k, random.next())};
    WavelengthData data;
    data.wavelength_nm = 550;
    for (const double angle : angle_set.empty() ? random_angles(&random) : angle_set) {
        const Reflection<double> r =
            reflect(ComplexIndex<double>{truth.n, truth.k}, std::cos(angle * pi / 180));
        data.points.push_back(
            make_angle_point(angle, psi(r) * 180 / pi, delta(r) * 180 / pi, 0.05, 0.1));
    }
    const FittedPoint point = procedure.random_start
                                  ? fit_point_from(data, procedure.estimator, start)
                                  : fit_point(data, procedure.estimator);
    if (!point.identifiable) {
        ++counts->refused;
    } else if (std::hypot(point.n - truth.n, point.k - truth.k) <
               1e-4 * std::hypot(truth.n, truth.k)) {
        ++counts->truth;
    } else if (point.chi2 < 4) {
        ++counts->equal;
    } else {
        ++counts->elsewhere;  // NaN too, which no fit may report
        counts->least_chi2 = std::min(counts->least_chi2, point.chi2);
    }
}

struct Panel {
    const Procedure* procedure;
    const std::vector<double>* angles;
    std::vector<Counts> counts;  // row-major, k growing with the row
};

std::vector<Panel> run_panels(int trials) {
    std::vector<Panel> panels;
    for (const Procedure& procedure : procedures) {
        for (const std::vector<double>& angles : angle_sets) {
            Panel panel{&procedure, &angles, std::vector<Counts>(cells * cells)};
            // The same metals, starts and angles for every procedure.
            const auto set = static_cast<uint32_t>(&angles - angle_sets.data());
            parallel_for(cells * cells, 0, [&](size_t i) {
                const int row = static_cast<int>(i) / cells, column = static_cast<int>(i) % cells;
                for (int trial = 0; trial < trials; ++trial) {
                    run_trial(procedure, angles, column, row,
                              {set, static_cast<uint32_t>(i), static_cast<uint32_t>(trial)},
                              &panel.counts[i]);
                }
            });
            panels.push_back(std::move(panel));
        }
    }
    return panels;
}

std::string to_csv(const std::vector<Panel>& panels) {
    std::string csv =
        "procedure,angles_deg,n_from,n_to,k_from,k_to,truth,equal,elsewhere,refused\n";
    for (const Panel& panel : panels) {
        for (int row = 0; row < cells; ++row) {
            for (int column = 0; column < cells; ++column) {
                const Counts& c = panel.counts[static_cast<size_t>(row * cells + column)];
                csv += fmt::format("\"{}\",{},{:.6g},{:.6g},{:.6g},{:.6g},{},{},{},{}\n",
                                   panel.procedure->name, angles_name(*panel.angles),
                                   logarithmic(low_n, high_n, 1.0 * column / cells),
                                   logarithmic(low_n, high_n, (column + 1.0) / cells),
                                   logarithmic(low_k, high_k, 1.0 * row / cells),
                                   logarithmic(low_k, high_k, (row + 1.0) / cells), c.truth,
                                   c.equal, c.elsewhere, c.refused);
            }
        }
    }
    return csv;
}

// ---- the picture
// -------------------------------------------------------------------------------------

constexpr int cell_pixels = 6, side = cells * cell_pixels, gap = 26, left = 70, top = 64;
constexpr int line_height = 24, font = 2;

void draw_ticks(Picture* picture, int x, int y, bool with_k, const Colour& ink) {
    for (const double value : {0.1, 1.0, 10.0}) {
        const double along_n = std::log(value / low_n) / std::log(high_n / low_n);
        const double along_k = std::log(value / low_k) / std::log(high_k / low_k);
        const std::string text = fmt::format("{:g}", value);
        const int width = font * text_width(text);
        const int tick_x = x + static_cast<int>(along_n * side);
        fill_rectangle(*picture, tick_x, y + side, 1, 4, ink);
        draw_text(*picture, tick_x - width / 2, y + side + 6, text, ink, font);
        if (!with_k) continue;
        const int tick_y = y + side - static_cast<int>(along_k * side);
        fill_rectangle(*picture, x - 4, tick_y, 4, 1, ink);
        draw_text(*picture, x - 8 - width, tick_y - 7, text, ink, font);
    }
}

Picture draw(const std::vector<Panel>& panels) {
    const Colour white = srgb_colour(255, 255, 255), ink = srgb_colour(0, 0, 0),
                 grey = srgb_colour(190, 190, 190);
    const int columns = static_cast<int>(angle_sets.size());
    const int rows = static_cast<int>(procedures.size());
    const int row_height = side + 2 * line_height + gap;
    const ColourBar bar{ColourMap::sequential, 0, 1, "truth"};
    const int bar_x = left + columns * (side + gap) + 10;
    Picture picture(bar_x + colour_bar_width(bar, font) + 20, top + rows * row_height, white);
    draw_text(picture, left, 12,
              "Fraction of fits that end at the truth. Across: n, up: k, both logarithmic.", ink,
              font);
    draw_text(picture, left, 36, "Grey: every fit is refused. Above each panel: angles in degrees.",
              ink, font);
    for (const Panel& panel : panels) {
        const int column = static_cast<int>(panel.angles - angle_sets.data());
        const int row = static_cast<int>(panel.procedure - procedures.data());
        const int x = left + column * (side + gap);
        const int y = top + row * row_height + 2 * line_height;
        if (column == 0) draw_text(picture, x, y - 46, panel.procedure->name, ink, font);
        // Six angles do not fit above their panel one by one.
        const std::string title = panel.angles->size() > 2
                                      ? fmt::format("{} of {:g}..{:g}", panel.angles->size(),
                                                    panel.angles->front(), panel.angles->back())
                                      : angles_name(*panel.angles);
        draw_text(picture, x, y - 20, title, ink, font);
        for (int i = 0; i < cells * cells; ++i) {
            const Counts& c = panel.counts[static_cast<size_t>(i)];
            const double share = static_cast<double>(c.truth) / c.all();
            fill_rectangle(picture, x + i % cells * cell_pixels,
                           y + side - (i / cells + 1) * cell_pixels, cell_pixels, cell_pixels,
                           c.refused == c.all() ? grey : map_colour(bar.map, share));
        }
        draw_frame(picture, x - 1, y - 1, side + 2, side + 2, ink);
        draw_ticks(&picture, x, y, column == 0, ink);
    }
    draw_text(picture, bar_x, top + 2 * line_height - 20, bar.label, ink, font);
    draw_colour_bar(picture, bar_x, top + 2 * line_height, side, bar, ink, font);
    return picture;
}

void print_sums(const std::vector<Panel>& panels) {
    fmt::print("{:<26}{:<20}{:>9}{:>9}{:>9}{:>11}{:>18}\n", "procedure", "angles", "truth", "equal",
               "refused", "elsewhere", "least chi2 there");
    for (const Panel& panel : panels) {
        Counts sum;
        for (const Counts& c : panel.counts) sum.add(c);
        const auto share = [&](int count) { return 100.0 * count / sum.all(); };
        fmt::print("{:<26}{:<20}{:>8.2f}%{:>8.2f}%{:>8.2f}%{:>10.2f}%{}\n", panel.procedure->name,
                   angles_name(*panel.angles), share(sum.truth), share(sum.equal),
                   share(sum.refused), share(sum.elsewhere),
                   sum.elsewhere > 0 ? fmt::format("{:>18.3g}", sum.least_chi2) : "");
    }
}

}  // namespace

int main(int argc, char** argv) {
    const auto trials = argc == 3 ? parse_unsigned(argv[2]) : 16;
    if (argc < 2 || argc > 3 || !trials || *trials < 1 || *trials > 10000) {
        fmt::print(stderr, "expected stability_map FOLDER [TRIALS], from 1 to 10000\n");
        return 2;
    }
    try {
        const std::vector<Panel> panels = run_panels(static_cast<int>(*trials));
        const std::string folder = argv[1];
        make_folder(folder);
        write_file(folder + "/stability_map.csv", to_csv(panels));
        const Picture picture = draw(panels);
        write_png(folder + "/stability_map.png", picture.width, picture.height, picture.rgb);
        print_sums(panels);
    } catch (const Error& error) {
        fmt::print(stderr, "{}\n", error.message());
        return static_cast<int>(error.cause());
    }
    return 0;
}
