#include "report/regress_page.h"

#include <algorithm>
#include <cmath>

#include "image/colour_map.h"
#include "image/difference.h"
#include "image/picture.h"
#include "report/page.h"

namespace drude {

namespace {

// Pixels are small pictures' atoms: enlarged by whole numbers, never blurred.
int enlargement(const Image& image) {
    return std::max(1, 192 / std::max(image.width, image.height));
}

Picture enlarged(const Picture& picture, int factor) {
    Picture result(picture.width * factor, picture.height * factor, {});
    for (int y = 0; y < result.height; ++y) {
        for (int x = 0; x < result.width; ++x) {
            result.set(x, y, picture.at(x / factor, y / factor));
        }
    }
    return result;
}

// Panels side by side with a gap between.
PagePicture strip(const std::vector<Picture>& panels, int factor, const std::string& alt) {
    constexpr int gap = 8;
    const int count = static_cast<int>(panels.size());
    const int width = panels[0].width * factor, height = panels[0].height * factor;
    Picture sheet(count * width + (count - 1) * gap, height, {1.0F, 1.0F, 1.0F});
    for (int i = 0; i < count; ++i) {
        draw_picture(sheet, i * (width + gap), 0, enlarged(panels[static_cast<size_t>(i)], factor));
    }
    return {encode_png(sheet.width, sheet.height, sheet.rgb), alt};
}

std::vector<std::string> colours(const std::string& layer) {
    if (layer.empty()) return {"R", "G", "B"};
    return {layer + ".R", layer + ".G", layer + ".B"};
}

std::vector<double> mean_of(const Image& image, const std::string& layer) {
    std::vector<double> mean(image.pixels());
    for (const std::string& name : colours(layer)) {
        const Channel& channel = image.at(name, "picture");
        for (size_t i = 0; i < mean.size(); ++i) {
            mean[i] += static_cast<double>(channel.data[i]) / 3.0;
        }
    }
    return mean;
}

Picture colour_panel(const Image& image, const std::string& layer, double gain) {
    Picture panel(image.width, image.height, {});
    for (size_t c = 0; c < 3; ++c) {
        const Channel& channel = image.at(colours(layer)[c], "picture");
        for (size_t i = 0; i < image.pixels(); ++i) {
            panel.rgb[3 * i + c] = channel.data[i] * static_cast<float>(gain);
        }
    }
    return panel;
}

struct Scales {
    double gain = 1.0;       // of S0
    double polarised = 1.0;  // what the ends of the map stand for in S1..S3
};

// Both pictures of a pair are shown alike; the reference says how.
Scales scales_of(const Image& reference, bool stokes) {
    Scales scales;
    std::vector<double> s0 = mean_of(reference, stokes ? "S0" : "");
    const auto nth = s0.begin() + static_cast<std::ptrdiff_t>(s0.size() * 95 / 100);
    std::nth_element(s0.begin(), nth, s0.end());
    if (*nth > 0) scales.gain = 0.7 / *nth;
    double largest = 0;
    for (const char* layer : {"S1", "S2", "S3"}) {
        if (!stokes) break;
        for (const double value : mean_of(reference, layer)) {
            if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
        }
    }
    if (largest > 0) scales.polarised = largest;
    return scales;
}

PagePicture picture_strip(const Image& image, bool stokes, const Scales& scales,
                          const std::string& alt) {
    std::vector<Picture> panels = {colour_panel(image, stokes ? "S0" : "", scales.gain)};
    const ColourBar bar = {ColourMap::diverging, -scales.polarised, scales.polarised, ""};
    for (const char* layer : {"S1", "S2", "S3"}) {
        if (!stokes) break;
        panels.push_back(map_values(image.width, image.height, mean_of(image, layer), bar));
    }
    return strip(panels, enlargement(image), alt);
}

// Of the three colours of a layer the one that is furthest off, pixel by pixel.
PagePicture difference_strip(const CaseResult& result) {
    const Image &a = result.rendered, &b = result.reference;
    std::vector<std::string> layers = {""};
    if (result.declared.stokes) layers = {"S0", "S1", "S2", "S3"};
    const ColourBar bar = standard_error_bar();
    std::vector<Picture> panels;
    for (const std::string& layer : layers) {
        const std::vector<double> z =
            standard_error_difference(a, b, colours(layer), "the new picture", "the reference");
        panels.push_back(map_values(a.width, a.height, z, bar));
    }
    return strip(panels, enlargement(a), "difference in standard errors");
}

void add_case(const CaseResult& result, Page* page) {
    const ReferenceCase& one = result.declared;
    page->heading(fmt::format("{}: {}", one.name, status_word(result.status)));
    page->paragraph(one.purpose);
    std::vector<std::pair<std::string, std::string>> facts = {
        {"Verdict", result.message},
        {"New picture", fmt::format("{} samples a pixel, seed {}", one.samples, result.seed)},
        {"Reference",
         fmt::format("{} samples a pixel, seed {}", one.reference_samples, one.reference_seed)}};
    if (!one.history.empty()) {
        const ReferenceUpdate& last = one.history.back();
        facts.push_back(
            {"Last update", fmt::format("{} (drude {}): {}", last.date, last.version, last.why)});
    }
    page->facts(facts);
    if (result.comparison && result.comparison->noise) {
        const Scales scales = scales_of(result.reference, one.stokes);
        const PagePicture now =
            picture_strip(result.rendered, one.stokes, scales, one.name + ", new picture");
        const PagePicture then =
            picture_strip(result.reference, one.stokes, scales, one.name + ", reference");
        const std::string panels =
            one.stokes ? fmt::format(
                             "From left to right S0, S1, S2, S3; S1 to S3 from {:.3g} "
                             "(blue) to {:.3g} (orange).",
                             -scales.polarised, scales.polarised)
                       : "Linear R, G, B.";
        page->comparison(now, "new", then, "reference", panels);
        page->begin_grid();
        page->swap(now, then,
                   "The new picture; the reference while the pointer is over it, or with the focus "
                   "on it.");
        page->picture(difference_strip(result),
                      fmt::format("New minus reference in standard errors, of the colour that is "
                                  "furthest off: {:g} (blue) to {:g} (orange).",
                                  standard_error_bar().low, standard_error_bar().high));
        page->end_grid();
    } else if (result.rendered.width > 0) {
        // There is nothing to hold it against; what was rendered is seen all the same.
        const Scales scales = scales_of(result.rendered, one.stokes);
        page->picture(
            picture_strip(result.rendered, one.stokes, scales, one.name + ", new picture"),
            "The new picture.");
    }
    page->code(fmt::format("# render again, compare\n{}\n{}\n# make it the reference\n{}",
                           result.render_command, result.compare_command, result.update_command));
}

// The smallest doubles end at 1e-308.
std::string p_text(double p) {
    return p > 0 ? fmt::format("{:.3g}", p) : "< 1e-300";
}

PageTable means_table(const RegressResult& run) {
    PageTable table;
    table.caption =
        "Every case. p is corrected for all tests of the case; the bias is what the means of this "
        "pair could have revealed, as a fraction of S0.";
    table.columns = {"case", "verdict", "p", "smallest visible bias", "RMSE", "seconds", "purpose"};
    table.numeric = {false, false, true, true, true, true, false};
    for (const CaseResult& result : run.cases) {
        const bool compared = result.comparison && result.comparison->noise;
        table.rows.push_back({result.declared.name, std::string(status_word(result.status)),
                              compared ? p_text(result.comparison->noise->p_min) : "",
                              compared ? fmt::format("{:.2g}", result.detectable_bias) : "",
                              compared ? fmt::format("{:.2g}", result.comparison->all.rmse) : "",
                              fmt::format("{:.2f}", result.seconds), result.declared.purpose});
    }
    return table;
}

}  // namespace

std::string regress_page(const ReferenceManifest& manifest, const RegressResult& run) {
    Page page("Regression against reference pictures");
    page.banner("drude " DRUDE_VERSION,
                fmt::format("{} of {} cases of {} passed, {} did not, {} were not reached. An "
                            "unchanged program fails "
                            "such a run with a probability of at most {:g}.",
                            run.count(CaseStatus::passed), run.cases.size(), manifest.folder,
                            run.failed(), run.count(CaseStatus::skipped), run.alpha));
    if (run.failed() > 0) {
        page.section("Not passed", "failed");
        for (const CaseResult& result : run.cases) {
            if (!result.good() && result.status != CaseStatus::skipped) add_case(result, &page);
        }
    }
    page.section("All cases", "all");
    page.table(means_table(run));
    if (run.count(CaseStatus::passed) > 0) {
        page.section("Passed", "passed");
        for (const CaseResult& result : run.cases) {
            if (result.good()) add_case(result, &page);
        }
    }
    return page.html();
}

}  // namespace drude
