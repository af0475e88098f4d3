#include "report/ticks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace drude {

namespace {

// 10 to an integer power, correctly rounded: pow() need not be.
double power_of_ten(int exponent) {
    return std::stod(fmt::format("1e{}", exponent));
}

std::string superscript(int exponent) {
    static const std::array<const char*, 10> digits = {"⁰", "¹", "²", "³", "⁴",
                                                       "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string out = exponent < 0 ? "⁻" : "";
    for (const char c : fmt::format("{}", std::abs(exponent)))
        out += digits[static_cast<size_t>(c - '0')];
    return out;
}

std::string decade_label(int exponent) {
    if (exponent >= 0 && exponent <= 4) return fmt::format("{:.0f}", power_of_ten(exponent));
    if (exponent < 0 && exponent >= -3)
        return fmt::format("{:.{}f}", power_of_ten(exponent), -exponent);
    return "10" + superscript(exponent);
}

}  // namespace

std::vector<Tick> linear_ticks(double low, double high, int most) {
    if (!std::isfinite(low) || !std::isfinite(high) || !(low < high)) return {};
    const double count = std::max(most, 2);
    const double span = high - low;
    if (!std::isfinite(span)) return {};
    // The exponent of a step that is surely too fine, then upwards through 1-2-5.
    int exponent = static_cast<int>(std::floor(std::log10(span / count))) - 1;
    if (exponent < -300) return {};
    int mantissa = 1;
    const auto multiples = [&](double scale) {
        const double slack = 1e-9;  // of a step: an end that falls on a tick has it
        return std::pair(std::ceil(low / scale - slack), std::floor(high / scale + slack));
    };
    for (;;) {
        const double step = mantissa * power_of_ten(exponent);
        const auto [first, last] = multiples(step);
        if (last - first + 1 <= count) {
            std::vector<Tick> ticks;
            const int decimals = std::max(0, -exponent);
            const double largest = std::max(std::abs(low), std::abs(high));
            for (double i = first; i <= last; ++i) {
                // Division by a power of ten is correctly rounded, multiplication by 0.1 is not.
                double value = exponent < 0 ? i * mantissa / power_of_ten(-exponent) : i * step;
                if (value == 0) value = 0;  // no minus sign before zero
                const bool plain = decimals <= 6 && largest < 1e6;
                ticks.push_back({value, plain ? fmt::format("{:.{}f}", value, decimals)
                                              : fmt::format("{:g}", value)});
            }
            return ticks;
        }
        if (mantissa == 5) ++exponent;
        mantissa = mantissa == 1 ? 2 : mantissa == 2 ? 5 : 1;
    }
}

std::vector<Tick> log_ticks(double low, double high, int most) {
    if (!std::isfinite(low) || !std::isfinite(high) || !(0 < low && low < high)) return {};
    constexpr double slack = 1e-9;
    const int first = static_cast<int>(std::ceil(std::log10(low) - slack));
    const int last = static_cast<int>(std::floor(std::log10(high) + slack));
    const int every = std::max(1, (last - first) / std::max(most, 2) + 1);
    std::vector<Tick> ticks;
    int labelled = 0;
    const bool short_range = high / low < 100;
    for (int exponent = first - 1; exponent <= last; ++exponent) {
        if (exponent < -307 || exponent > 307) continue;
        for (int mantissa = 1; mantissa <= 9; ++mantissa) {
            const double value = mantissa * power_of_ten(exponent);
            if (value < low * (1 - slack) || value > high * (1 + slack)) continue;
            std::string label;
            if (mantissa == 1) {
                if ((exponent - first) % every == 0) label = decade_label(exponent);
            } else if (short_range && (mantissa == 2 || mantissa == 5)) {
                label = fmt::format("{:g}", value);
            } else if (last - first > 6) {
                continue;
            }
            labelled += !label.empty();
            ticks.push_back({value, label});
        }
    }
    return labelled >= 2 ? ticks : linear_ticks(low, high, most);
}

}  // namespace drude
