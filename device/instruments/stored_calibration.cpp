#include "device/instruments/stored_calibration.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/numbers.h"
#include "device/device_error.h"

namespace drude {

namespace {

double polynomial(const std::vector<double>& coefficients, double x) {
    double sum = 0;
    for (size_t i = coefficients.size(); i-- > 0;) sum = sum * x + coefficients[i];
    return sum;
}

std::string shown(const std::vector<double>& coefficients) {
    std::vector<std::string> words;
    for (const double c : coefficients) words.push_back(format_double(c));
    return fmt::format("{}", fmt::join(words, ", "));
}

bool all_finite(const std::vector<double>& coefficients) {
    return std::all_of(coefficients.begin(), coefficients.end(),
                       [](double c) { return std::isfinite(c); });
}

}  // namespace

std::string stored_text(std::span<const uint8_t> bytes) {
    std::string text;
    for (const uint8_t byte : bytes) {
        if (byte == 0 || byte == 0xFF) break;
        text += byte >= 32 && byte < 127 ? static_cast<char>(byte) : '?';
    }
    const size_t first = text.find_first_not_of(' ');
    if (first == std::string::npos) return {};
    return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

std::vector<double> polynomial_wavelengths(const std::vector<double>& coefficients, int pixels,
                                           int origin, const std::string& device) {
    std::vector<double> wavelengths;
    for (int i = 0; i < pixels; ++i) wavelengths.push_back(polynomial(coefficients, i + origin));
    for (size_t i = 0; i < wavelengths.size(); ++i) {
        const char* what = nullptr;
        if (!std::isfinite(wavelengths[i])) {
            what = "is not a number";
        } else if (wavelengths[i] <= 0) {
            what = "is not positive";
        } else if (i > 0 && wavelengths[i] <= wavelengths[i - 1]) {
            what = "does not lie above that of the pixel before";
        }
        if (!what) continue;
        device_error(Fault::bad_frame,
                     "{}: the wavelength calibration in its memory cannot be used: the wavelength "
                     "of pixel {}, {} nm, {} (coefficients {})",
                     device, i, format_double(wavelengths[i]), what, shown(coefficients));
    }
    return wavelengths;
}

std::string why_nonlinearity_is_unusable(const std::vector<double>& coefficients,
                                         uint32_t max_counts) {
    if (coefficients.empty()) return "there are none";
    if (!all_finite(coefficients)) return "one is not a number: " + shown(coefficients);
    if (coefficients[0] == 0) return "the first is 0: " + shown(coefficients);
    constexpr int steps = 256;
    for (int i = 0; i <= steps; ++i) {
        const double counts = static_cast<double>(max_counts) * i / steps;
        const double divisor = polynomial(coefficients, counts);
        if (divisor >= 0.5 && divisor <= 2) continue;
        return fmt::format("they would divide {} counts by {}: {}", format_double(counts),
                           format_double(divisor), shown(coefficients));
    }
    return {};
}

}  // namespace drude
