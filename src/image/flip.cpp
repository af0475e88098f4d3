#include "image/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "base/executor.h"
#include "image/opponent_colour.h"

namespace drude {

namespace {

using std::numbers::pi;
using Plane = std::vector<double>;
using Planes = std::array<Plane, 3>;

// ---- filters
// -----------------------------------------------------------------------------------

// One-dimensional weights, from -radius to radius.
using Kernel = std::vector<double>;

template <class Function>
Kernel kernel_of(int radius, Function function) {
    Kernel kernel;
    for (int i = -radius; i <= radius; ++i) kernel.push_back(function(static_cast<double>(i)));
    return kernel;
}

double sum_of(const Kernel& kernel) {
    double sum = 0.0;
    for (const double weight : kernel) sum += weight;
    return sum;
}

// Along x, then along y; edges are repeated outwards.
class Filter {
  public:
    Filter(int width, int height, int threads)
        : width_(width), height_(height), threads_(threads) {}

    Plane operator()(const Plane& plane, const Kernel& along_x, const Kernel& along_y) const {
        return pass(pass(plane, along_x, true), along_y, false);
    }

  private:
    Plane pass(const Plane& plane, const Kernel& kernel, bool along_x) const {
        const int radius = static_cast<int>(kernel.size()) / 2;
        Plane result(plane.size());
        parallel_for(static_cast<size_t>(height_), threads_, [&](size_t row) {
            const int y = static_cast<int>(row);
            for (int x = 0; x < width_; ++x) {
                double sum = 0.0;
                for (int i = -radius; i <= radius; ++i) {
                    const int at_x = along_x ? std::clamp(x + i, 0, width_ - 1) : x;
                    const int at_y = along_x ? y : std::clamp(y + i, 0, height_ - 1);
                    sum += kernel[static_cast<size_t>(i + radius)] * plane[index(at_x, at_y)];
                }
                result[index(x, y)] = sum;
            }
        });
        return result;
    }
    size_t index(int x, int y) const {
        return static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x);
    }

    int width_, height_, threads_;
};

// The eye's contrast sensitivity in each opponent channel as sums of two Gaussians
// a sqrt(pi/b) exp(-pi^2 d^2 / b), d in degrees (table 1 of the paper).
struct Sensitivity {
    double a1, b1, a2, b2;
};
constexpr Sensitivity sensitivities[3] = {
    {1.0, 0.0047, 0.0, 1e-5}, {1.0, 0.0053, 0.0, 1e-5}, {34.1, 0.04, 13.5, 0.025}};

Plane blurred(const Plane& plane, const Sensitivity& sensitivity, double ppd,
              const Filter& filter) {
    // The widest of all Gaussians, three standard deviations of it, is the window of each.
    const int radius = static_cast<int>(std::ceil(3.0 * std::sqrt(0.04 / (2.0 * pi * pi)) * ppd));
    Plane total(plane.size(), 0.0);
    double norm = 0.0;
    for (const auto& [a, b] :
         {std::pair(sensitivity.a1, sensitivity.b1), std::pair(sensitivity.a2, sensitivity.b2)}) {
        if (a == 0.0) continue;
        const double width = b;
        const Kernel kernel = kernel_of(
            radius, [&](double i) { return std::exp(-pi * pi * (i / ppd) * (i / ppd) / width); });
        const double scale = a * std::sqrt(pi / b), sum = sum_of(kernel);
        const Plane part = filter(plane, kernel, kernel);
        for (size_t i = 0; i < total.size(); ++i) total[i] += scale * part[i];
        norm += scale * sum * sum;
    }
    for (double& value : total) value /= norm;
    return total;
}

// A derivative's weights, positive ones to a sum of 1, negative ones to a sum of -1.
Kernel balanced(Kernel kernel) {
    double positive = 0.0, negative = 0.0;
    for (const double weight : kernel) (weight > 0.0 ? positive : negative) += weight;
    for (double& weight : kernel) weight /= weight > 0.0 ? positive : -negative;
    return kernel;
}

struct Features {
    Plane edge, point;
};

// Edges and points of the lightness, by the first and the second derivative of a Gaussian as wide
// as what the eye resolves as a feature, 0.082 degrees.
Features features_of(const Plane& lightness, double ppd, const Filter& filter) {
    const double sigma = 0.5 * 0.082 * ppd;
    const int radius = static_cast<int>(std::ceil(3.0 * sigma));
    const auto gauss = [&](double x) { return std::exp(-x * x / (2.0 * sigma * sigma)); };
    Kernel smooth = kernel_of(radius, gauss);
    const double norm = sum_of(smooth);
    for (double& weight : smooth) weight /= norm;
    const Kernel first = balanced(kernel_of(radius, [&](double x) { return -x * gauss(x); }));
    const Kernel second = balanced(
        kernel_of(radius, [&](double x) { return (x * x / (sigma * sigma) - 1.0) * gauss(x); }));
    const auto magnitude = [&](const Kernel& derivative) {
        const Plane along_x = filter(lightness, derivative, smooth);
        const Plane along_y = filter(lightness, smooth, derivative);
        Plane result(lightness.size());
        for (size_t i = 0; i < result.size(); ++i) result[i] = std::hypot(along_x[i], along_y[i]);
        return result;
    };
    return {magnitude(first), magnitude(second)};
}

// ---- the metric
// -----------------------------------------------------------------------------------

Planes opponent_planes(const std::vector<Triple>& rgb) {
    Planes planes;
    for (Plane& plane : planes) plane.resize(rgb.size());
    for (size_t i = 0; i < rgb.size(); ++i) {
        const Triple opponent = opponent_of(rgb[i]);
        for (size_t c = 0; c < 3; ++c) planes[c][i] = opponent[c];
    }
    return planes;
}

// What the eye makes of the colours: blurred, clipped to the display's range, in Hunt's Lab.
std::vector<Triple> perceived(const Planes& opponent, double ppd, const Filter& filter) {
    Planes blurry;
    for (size_t c = 0; c < 3; ++c) {
        blurry[c] = blurred(opponent[c], sensitivities[c], ppd, filter);
    }
    std::vector<Triple> result(blurry[0].size());
    for (size_t i = 0; i < result.size(); ++i) {
        Triple rgb = rgb_of_opponent({blurry[0][i], blurry[1][i], blurry[2][i]});
        for (double& value : rgb) value = std::clamp(value, 0.0, 1.0);
        result[i] = hunt_lab_of(rgb);
    }
    return result;
}

Features features_of(const Planes& opponent, double ppd, const Filter& filter) {
    Plane lightness = opponent[0];
    for (double& value : lightness) value = (value + 16.0) / 116.0;
    return features_of(lightness, ppd, filter);
}

// Section 4.1.3: distances to the power 0.7, and the lower 40 % of their range stretched over 95 %.
double colour_error(const Triple& a, const Triple& b) {
    static const double largest =
        std::pow(hyab(hunt_lab_of({0.0, 1.0, 0.0}), hunt_lab_of({0.0, 0.0, 1.0})), 0.7);
    constexpr double knee = 0.4, at_knee = 0.95;
    const double distance = std::pow(hyab(a, b), 0.7), bend = knee * largest;
    return distance < bend ? distance * at_knee / bend
                           : at_knee + (distance - bend) / (largest - bend) * (1.0 - at_knee);
}

std::vector<double> flip_errors(const std::vector<Triple>& test,
                                const std::vector<Triple>& reference, double ppd,
                                const Filter& filter) {
    const Planes opponent_a = opponent_planes(test), opponent_b = opponent_planes(reference);
    const std::vector<Triple> a = perceived(opponent_a, ppd, filter);
    const std::vector<Triple> b = perceived(opponent_b, ppd, filter);
    const Features in_a = features_of(opponent_a, ppd, filter);
    const Features in_b = features_of(opponent_b, ppd, filter);
    std::vector<double> errors(a.size());
    for (size_t i = 0; i < errors.size(); ++i) {
        const double feature = std::max(std::abs(in_a.edge[i] - in_b.edge[i]),
                                        std::abs(in_a.point[i] - in_b.point[i]));
        const double feature_error = std::sqrt(feature / std::numbers::sqrt2);
        errors[i] = std::pow(colour_error(a[i], b[i]), 1.0 - feature_error);
    }
    return errors;
}

// ---- exposures
// -----------------------------------------------------------------------------------

// Narkowicz's fit of the ACES curve (K. Narkowicz, "ACES Filmic Tone Mapping Curve", 2016), with
// the authors' factor of 0.6 before it taken in: (a x^2 + b x + c) / (d x^2 + e x + f).
struct ToneCurve {
    double a = 0.6 * 0.6 * 2.51, b = 0.6 * 0.03, c = 0.0;
    double d = 0.6 * 0.6 * 2.43, e = 0.6 * 0.59, f = 0.14;

    double operator()(double x) const { return ((a * x + b) * x + c) / ((d * x + e) * x + f); }
    // The x >= 0 that becomes y in (0, 1).
    double inverse(double y) const {
        const double qa = a - y * d, qb = b - y * e, qc = c - y * f;
        return (-qb + std::sqrt(qb * qb - 4.0 * qa * qc)) / (2.0 * qa);
    }
};

std::vector<Triple> pixels_of(const Picture& picture) {
    std::vector<Triple> pixels(picture.rgb.size() / 3);
    for (size_t i = 0; i < pixels.size(); ++i) {
        for (size_t c = 0; c < 3; ++c) {
            const double value = static_cast<double>(picture.rgb[3 * i + c]);
            pixels[i][c] = std::isfinite(value) ? value : 0.0;
        }
    }
    return pixels;
}

std::vector<Triple> exposed(std::vector<Triple> pixels, double exposure, bool tone_mapped) {
    const double gain = std::exp2(exposure);
    const ToneCurve curve;
    for (Triple& pixel : pixels) {
        for (double& value : pixel) {
            if (tone_mapped) value = curve(gain * std::max(0.0, value));
            value = std::clamp(value, 0.0, 1.0);
        }
    }
    return pixels;
}

void check_sizes(const Picture& test, const Picture& reference) {
    if (test.width != reference.width || test.height != reference.height || test.rgb.empty() ||
        test.rgb.size() != reference.rgb.size()) {
        throw std::logic_error("flip: pictures of different sizes");
    }
}

double mean_of(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

// From the exposure at which the brightest pixel of the reference becomes 0.85 to that at which the
// median one does (section 3 of the HDR paper).
void choose_exposures(const std::vector<Triple>& reference, FlipResult* result) {
    std::vector<double> luminance;
    for (const Triple& pixel : reference) luminance.push_back(xyz_of(pixel)[1]);
    std::sort(luminance.begin(), luminance.end());
    // Of an even number of pixels the upper of the two in the middle, as in the authors' program.
    const double median = luminance[luminance.size() / 2];
    // The authors' program holds a black median at the float's epsilon.
    const double bright = ToneCurve().inverse(0.85);
    constexpr double smallest = 1.1920928955078125e-7;
    if (!(luminance.back() > 0.0)) return;
    result->start_exposure = std::log2(bright / luminance.back());
    result->stop_exposure = std::log2(bright / std::max(median, smallest));
    result->exposures =
        static_cast<int>(std::max(2.0, std::ceil(result->stop_exposure - result->start_exposure)));
}

}  // namespace

FlipResult flip_ldr(const Picture& test, const Picture& reference, const FlipOptions& options) {
    check_sizes(test, reference);
    const Filter filter(test.width, test.height, options.threads);
    FlipResult result;
    result.error =
        flip_errors(exposed(pixels_of(test), 0.0, false), exposed(pixels_of(reference), 0.0, false),
                    options.pixels_per_degree, filter);
    result.mean = mean_of(result.error);
    return result;
}

FlipResult flip_hdr(const Picture& test, const Picture& reference, const FlipOptions& options) {
    check_sizes(test, reference);
    const Filter filter(test.width, test.height, options.threads);
    const std::vector<Triple> in_test = pixels_of(test), in_reference = pixels_of(reference);
    FlipResult result;
    choose_exposures(in_reference, &result);
    result.error.assign(in_test.size(), 0.0);
    const double step =
        (result.stop_exposure - result.start_exposure) / std::max(1.0, result.exposures - 1.0);
    for (int i = 0; i < result.exposures; ++i) {
        const double exposure = result.start_exposure + i * step;
        const std::vector<double> errors =
            flip_errors(exposed(in_test, exposure, true), exposed(in_reference, exposure, true),
                        options.pixels_per_degree, filter);
        for (size_t p = 0; p < errors.size(); ++p) {
            result.error[p] = std::max(result.error[p], errors[p]);
        }
    }
    result.mean = mean_of(result.error);
    return result;
}

}  // namespace drude
