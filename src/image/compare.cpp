#include "image/compare.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "base/error.h"
#include "base/numbers.h"
#include "image/comparable.h"
#include "image/stokes_layer.h"

namespace drude {

namespace {

struct Totals {
    double difference = 0.0, absolute = 0.0, square = 0.0, relative_square = 0.0, symmetric = 0.0;
    double largest = 0.0, peak = 0.0;
    size_t count = 0;

    void add(double a, double b) {
        constexpr double epsilon = 1e-2;
        const double d = a - b;
        difference += d;
        absolute += std::abs(d);
        square += d * d;
        relative_square += d * d / (b * b + epsilon);
        const double sum = std::abs(a) + std::abs(b);
        if (sum > 0.0) symmetric += 2.0 * std::abs(d) / sum;
        largest = std::max(largest, std::abs(d));
        peak = std::max(peak, std::abs(b));
        ++count;
    }
    void add(const Totals& other) {
        difference += other.difference;
        absolute += other.absolute;
        square += other.square;
        relative_square += other.relative_square;
        symmetric += other.symmetric;
        largest = std::max(largest, other.largest);
        peak = std::max(peak, other.peak);
        count += other.count;
    }
    Figures figures() const {
        Figures result;
        if (count == 0) {
            // Nothing was compared, which is not the same as nothing being off.
            constexpr double none = std::numeric_limits<double>::quiet_NaN();
            result = {none, none, none, none, none, none, none};
            return result;
        }
        const double n = static_cast<double>(count);
        result.mean_error = difference / n;
        result.mae = absolute / n;
        result.rmse = std::sqrt(square / n);
        result.relmse = relative_square / n;
        result.smape = symmetric / n;
        result.psnr = result.rmse > 0.0 ? 20.0 * std::log10(peak / result.rmse)
                                        : std::numeric_limits<double>::infinity();
        result.max_error = largest;
        return result;
    }
};

bool is_variance(const std::string& name) {
    return name.rfind("variance.", 0) == 0;
}

// S0 to S3 of both: spectral layers where both have the same ones, otherwise R, G, B.
std::vector<std::vector<std::string>> stokes_channels(const Image& a, const Image& b) {
    std::vector<std::string> suffixes;
    if (wavelengths_of(a) == wavelengths_of(b)) {
        for (const Channel& channel : a.channels) {
            if (channel.name.rfind("S0.", 0) == 0 && layer_wavelength(channel.name)) {
                suffixes.push_back(channel.name.substr(3));
            }
        }
    }
    if (suffixes.empty()) suffixes = {"R", "G", "B"};
    std::vector<std::vector<std::string>> names(4);
    for (size_t i = 0; i < 4; ++i) {
        for (const std::string& suffix : suffixes) {
            names[i].push_back(fmt::format("S{}.{}", i, suffix));
            if (!a.find(names[i].back()) || !b.find(names[i].back())) return {};
        }
    }
    return names;
}

std::vector<std::string> default_channels(const Image& a, const Image& b) {
    const auto has_rgb = [](const Image& image) {
        return image.find("R") && image.find("G") && image.find("B");
    };
    if (!(has_rgb(a) && has_rgb(b)) && a.find("Y") && b.find("Y")) return {"Y"};
    return {"R", "G", "B"};
}

// S1.R to S3.B where both have all of them: what R, G, B do not show.
std::vector<std::string> polarised_channels(const Image& a, const Image& b) {
    std::vector<std::string> names;
    for (const char* layer : {"S1", "S2", "S3"}) {
        for (const char* colour : {"R", "G", "B"}) {
            names.push_back(fmt::format("{}.{}", layer, colour));
            if (!a.find(names.back()) || !b.find(names.back())) return {};
        }
    }
    return names;
}

// How large a difference of the means could have hidden in the noise: a pass says no more.
std::string blind_spot(const Comparison& result) {
    MeanTest worst;
    for (size_t c = 0; c < result.figure_channels.size(); ++c) {
        const MeanTest& mean = result.noise->means[c];
        if (mean.detectable_bias > worst.detectable_bias) worst = mean;
    }
    if (!(worst.detectable_bias > 0.0)) return "";
    const double share = 100.0 * worst.detectable_bias / std::abs(worst.reference);
    return fmt::format("; a difference of the means below {:.3g}{} would not show",
                       worst.detectable_bias,
                       std::isfinite(share) ? fmt::format(" ({:.3g} % of B's)", share) : "");
}

bool same_bits(const Image& a, const Image& b) {
    for (const Channel& channel : a.channels) {
        const Channel* other = b.find(channel.name);
        if (!other || std::memcmp(channel.data.data(), other->data.data(),
                                  channel.data.size() * sizeof(float)) != 0) {
            return false;
        }
    }
    return true;
}

bool within(const Tolerance& tolerance, double a, double b) {
    return std::abs(a - b) <=
           std::max(tolerance.absolute, tolerance.relative * std::max(std::abs(a), std::abs(b)));
}

void decide(const Image& a, const Image& b, const std::string& name_a, const std::string& name_b,
            const CompareOptions& options, Comparison& result) {
    const double values = static_cast<double>(a.pixels() * result.channels.size());
    if (options.exact) {
        result.decision = Decision::exact;
        result.same = same_bits(a, b);
        result.reason = result.same ? "every channel is the same bit for bit"
                                    : "the pixels are not the same bit for bit";
    } else if (options.tolerance) {
        const double percent = 100.0 * static_cast<double>(result.beyond_tolerance) / values;
        result.decision = Decision::tolerance;
        result.same = percent <= options.tolerance->percent;
        result.reason = fmt::format("{} of {} values ({:.4g} %) are beyond the tolerance",
                                    result.beyond_tolerance, values, percent);
    } else if (without_variance(a, result.channels).empty() &&
               without_variance(b, result.channels).empty()) {
        result.decision = Decision::noise;
        result.noise =
            noise_test(a, b, result.channels, name_a, name_b, options.alpha, options.threads);
        result.same = result.noise->p_min >= options.alpha;
        result.reason = fmt::format(
            "the difference is {} by noise: corrected p = {:.3g} against alpha = {:g}",
            result.same ? "explained" : "not explained", result.noise->p_min, options.alpha);
        if (result.same) result.reason += blind_spot(result);
    } else {
        result.decision = Decision::identical;
        result.same = result.not_finite == 0 &&
                      std::all_of(result.each.begin(), result.each.end(),
                                  [](const Figures& one) { return one.max_error == 0.0; });
        result.reason = result.same
                            ? "all values compared are equal"
                            : "the values are not equal (no variances to hold them against in both "
                              "files; --tolerance allows a difference)";
    }
}

}  // namespace

Tolerance parse_tolerance(const std::string& text) {
    Tolerance tolerance;
    double* fields[] = {&tolerance.absolute, &tolerance.relative, &tolerance.percent};
    size_t start = 0, field = 0;
    for (;; ++field) {
        const size_t comma = text.find(',', start);
        const std::string word = text.substr(start, comma - start);
        const std::optional<double> value = parse_double(word);
        if (field >= 3 || !value || !(*value >= 0.0) || !std::isfinite(*value)) {
            user_error(
                "--tolerance '{}': expected abs,rel,percent, up to three numbers of 0 or "
                "above, e.g. 1e-4,1e-3,0.1",
                text);
        }
        *fields[field] = *value;
        if (comma == std::string::npos) break;
        start = comma + 1;
    }
    if (tolerance.percent > 100.0) user_error("--tolerance '{}': more than 100 percent", text);
    return tolerance;
}

std::vector<std::string> parse_channels(const std::string& list, const Image& image,
                                        const std::string& where) {
    std::vector<std::string> pieces(1), names;
    for (const char letter : list) {
        if (letter == ',') {
            pieces.emplace_back();
        } else {
            pieces.back() += letter;
        }
    }
    const auto add = [&](const std::string& name) {
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    };
    for (size_t i = 0; i < pieces.size();) {
        // The longest run of pieces that is a channel's name; three are more than any name has.
        size_t used = 0;
        std::string word;
        for (size_t k = i; k < std::min(pieces.size(), i + 3); ++k) {
            word += (k > i ? "," : "") + pieces[k];
            if (!image.find(word)) continue;
            used = k - i + 1;
        }
        if (used > 0) {
            word = pieces[i];
            for (size_t k = 1; k < used; ++k) word += "," + pieces[i + k];
            add(word);
            i += used;
            continue;
        }
        const size_t before = names.size();
        for (const Channel& channel : image.channels) {
            const bool chosen = pieces[i] == "all" ? !is_variance(channel.name)
                                                   : channel.name.rfind(pieces[i] + ".", 0) == 0;
            if (chosen) add(channel.name);
        }
        if (names.size() == before) image.at(pieces[i], where);  // throws: no such channel
        ++i;
    }
    return names;
}

Comparison compare_images(const Image& a, const Image& b, const std::string& name_a,
                          const std::string& name_b, const CompareOptions& options) {
    check_size(a, b, name_a, name_b);
    if (!options.any_scene) check_scenes(a, b, name_a, name_b);
    const bool of_layers =
        std::any_of(options.channels.begin(), options.channels.end(),
                    [](const std::string& name) { return layer_wavelength(name).has_value(); });
    if (options.exact || of_layers) check_wavelengths(a, b, name_a, name_b);
    if (options.exact) check_same_names(a, b, name_a, name_b);
    Comparison result;
    result.channels = options.channels;
    result.figure_channels = options.channels;
    if (result.channels.empty()) {
        result.channels = default_channels(a, b);
        // With --exact any channels will do: the figures are then over all of them.
        if (options.exact && !a.find(result.channels.front())) result.channels = sorted_names(a);
        result.figure_channels = result.channels;
        for (const std::string& name : polarised_channels(a, b)) {
            if (std::find(result.channels.begin(), result.channels.end(), name) ==
                result.channels.end()) {
                result.channels.push_back(name);
            }
        }
    }
    Totals all;
    for (const std::string& name : result.channels) {
        const Channel& in_a = a.at(name, name_a);
        const Channel& in_b = b.at(name, name_b);
        Totals totals;
        for (size_t i = 0; i < a.pixels(); ++i) {
            const double va = static_cast<double>(in_a.data[i]);
            const double vb = static_cast<double>(in_b.data[i]);
            const bool finite = std::isfinite(va) && std::isfinite(vb);
            if (finite) {
                totals.add(va, vb);
            } else {
                ++result.not_finite;
            }
            if (options.tolerance && !(finite && within(*options.tolerance, va, vb))) {
                ++result.beyond_tolerance;
            }
        }
        result.each.push_back(totals.figures());
        if (result.each.size() <= result.figure_channels.size()) all.add(totals);
    }
    result.all = all.figures();
    for (const std::vector<std::string>& names : stokes_channels(a, b)) {
        Totals totals;
        for (const std::string& name : names) {
            const Channel& in_a = a.at(name, name_a);
            const Channel& in_b = b.at(name, name_b);
            for (size_t i = 0; i < a.pixels(); ++i) {
                const double va = static_cast<double>(in_a.data[i]);
                const double vb = static_cast<double>(in_b.data[i]);
                if (std::isfinite(va) && std::isfinite(vb)) totals.add(va, vb);
            }
        }
        result.stokes.push_back(totals.figures());
    }
    result.polarisation = polarisation_errors(a, b);
    decide(a, b, name_a, name_b, options, result);
    return result;
}

}  // namespace drude
