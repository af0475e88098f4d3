#include "regress/regress.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <limits>

#include "base/executor.h"
#include "base/interrupt.h"
#include "base/numbers.h"
#include "base/progress.h"
#include "image/student.h"
#include "render/render.h"
#include "scene/resolution.h"

namespace drude {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

Scene prepared_scene(const ReferenceManifest& manifest, const ReferenceCase& one) {
    Scene scene = read_scene(manifest.scene_path(one));
    if (!one.resolution.empty()) set_resolution(one.resolution, "'resolution'", &scene);
    return scene;
}

RenderResult render_case(const Scene& scene, const ReferenceCase& one, int samples, uint64_t seed,
                         int threads, bool quiet) {
    RenderOptions options;
    options.samples_per_pixel = samples;
    options.seed = seed;
    options.stokes = one.stokes;
    options.wavelengths = one.wavelengths;
    options.threads = threads;
    options.quiet = quiet;
    return render(scene, options);
}

// A word as a shell takes it.
std::string quoted(const std::string& word) {
    const auto plain = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               std::string_view("-_./=:,+@%").find(c) != std::string_view::npos;
    };
    if (!word.empty() && std::all_of(word.begin(), word.end(), plain)) return word;
    std::string result = "'";
    for (const char c : word) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return result + "'";
}

std::string render_command(const std::string& scene, const ReferenceCase& one, int samples,
                           uint64_t seed, const std::string& output) {
    std::string command = fmt::format("drude render {}{} --spp {} --seed {}", quoted(scene),
                                      one.stokes ? " --stokes" : "", samples, seed);
    if (one.wavelengths != 0) command += fmt::format(" --wavelengths {}", one.wavelengths);
    if (!one.resolution.empty()) command += " --resolution " + quoted(one.resolution);
    return command + " -o " + quoted(output);
}

// The bias of a mean of S0 (or R, G, B) that the pair could have revealed, as a fraction of it;
// infinite where that is 0, for a black picture shows nothing.
double relative_bias(const NoiseTest& noise) {
    double largest = 0;
    for (const MeanTest& mean : noise.means) {
        const bool is_s0 = mean.channel.size() == 1 || mean.channel.rfind("S0.", 0) == 0;
        if (!is_s0) continue;
        const double share = mean.reference != 0 ? mean.detectable_bias / std::abs(mean.reference)
                                                 : std::numeric_limits<double>::infinity();
        largest = std::max(largest, share);
    }
    return largest;
}

std::string where_found(const Finding& worst) {
    const std::string z = fmt::format("{:+.3g} standard errors", worst.z);
    switch (worst.family) {
        case TestFamily::mean:
            return fmt::format("the mean of {} is off by {}", worst.channel, z);
        case TestFamily::block:
            return fmt::format("the 8x8 block of {} at ({}, {}) is off by {}", worst.channel,
                               worst.x, worst.y, z);
        case TestFamily::pixel:
            break;
    }
    return fmt::format("{} at pixel ({}, {}) is off by {}", worst.channel, worst.x, worst.y, z);
}

void judge(CaseResult* result, double alpha) {
    const ReferenceCase& one = result->declared;
    const Comparison& comparison = *result->comparison;
    if (!comparison.noise) {
        result->status = CaseStatus::error;
        result->message = "the reference holds no variances; render it with --update";
        return;
    }
    const NoiseTest& noise = *comparison.noise;
    result->detectable_bias = relative_bias(noise);
    if (!comparison.same) {
        result->status = CaseStatus::failed;
        // The smallest doubles end at 1e-308.
        const std::string p =
            noise.p_min > 0 ? fmt::format("= {:.3g}", noise.p_min) : "below 1e-300";
        result->message = fmt::format("{}; corrected p {} against alpha = {:.3g}",
                                      where_found(noise.worst), p, alpha);
    } else if (!(result->detectable_bias <= one.largest_bias)) {
        result->status = CaseStatus::weak;
        result->message =
            std::isinf(result->detectable_bias)
                ? "no difference seen, but S0 is 0 everywhere in one colour or all: such a picture "
                  "shows nothing; give the scene light"
                : fmt::format(
                      "no difference seen, but a bias below {:.3g} of S0 could not be; the "
                      "manifest asks for {:.3g}: take more samples",
                      result->detectable_bias, one.largest_bias);
    } else {
        result->status = CaseStatus::passed;
        result->message = fmt::format("corrected p = {:.3g}; a bias of {:.3g} of S0 would show",
                                      noise.p_min, result->detectable_bias);
    }
    if (result->scene_changed) {
        result->message += "; the scene or a file it names is not the one of the reference";
    }
}

// What the renderer itself says is a defect of it, whatever the picture looks like; empty: nothing.
std::string defects_of(const RenderResult& rendered) {
    if (rendered.not_finite == 0 && rendered.projections == 0) return "";
    return fmt::format(
        "the renderer met {} contributions that are not finite and {} outside the cone of physical "
        "light",
        rendered.not_finite, rendered.projections);
}

// The picture must be the one that the manifest describes: one of the run's own seed would agree
// with the run exactly, and say nothing.
void check_reference(const ReferenceCase& one, const Image& reference, const std::string& path) {
    const std::string seed = reference.text("seed");
    if (seed != fmt::format("{}", one.reference_seed)) {
        user_error("{}: was rendered with {}; the manifest says {}; render it with --update", path,
                   seed.empty() ? "a seed it does not tell" : "seed " + seed, one.reference_seed);
    }
    const double samples = reference.number("samples", 0.0);
    if (!(samples >= one.reference_samples)) {
        user_error(
            "{}: was rendered with {:.0f} samples a pixel; the manifest says {}; render it with "
            "--update",
            path, samples, one.reference_samples);
    }
}

void run_case(const ReferenceManifest& manifest, double alpha, CaseResult* result) {
    const ReferenceCase& one = result->declared;
    const std::string reference = manifest.reference_path(one);
    const bool has_reference = std::filesystem::exists(reference);
    const Scene scene = prepared_scene(manifest, one);
    RenderResult rendered = render_case(scene, one, one.samples, result->seed, 1, true);
    const std::string defects = defects_of(rendered);
    result->rendered = std::move(rendered.image);
    if (rendered.interrupted) return;
    if (!has_reference) {
        result->status = CaseStatus::missing;
        result->message = fmt::format("{} is not there; render it with --update", reference);
        return;
    }
    result->reference = read_exr(reference);
    check_reference(one, result->reference, reference);
    result->scene_changed = result->reference.text("sceneHash") != scene.sha256;
    CompareOptions options;
    options.channels = reference_channels(one.stokes);
    options.alpha = alpha;
    options.any_scene = true;
    options.threads = 1;
    result->comparison =
        compare_images(result->rendered, result->reference, "the new picture", reference, options);
    judge(result, alpha);
    if (!defects.empty()) {
        result->status = CaseStatus::failed;
        result->message = defects + "; " + result->message;
    }
}

bool fits(const std::string& name, const std::string& pattern) {
    if (pattern.empty() || pattern.back() != '*') return name == pattern;
    return name.compare(0, pattern.size() - 1, pattern, 0, pattern.size() - 1) == 0;
}

std::vector<CaseResult> chosen_cases(const ReferenceManifest& manifest,
                                     const RegressOptions& options) {
    std::vector<std::string> names;
    for (const ReferenceCase& one : manifest.cases) names.push_back(one.name);
    for (const std::string& pattern : options.only) {
        const bool known = std::any_of(names.begin(), names.end(), [&](const std::string& name) {
            return fits(name, pattern);
        });
        if (!known) {
            user_error("--only '{}': {} has no such case{}", pattern, manifest.path(),
                       did_you_mean(pattern, names));
        }
    }
    std::vector<CaseResult> chosen;
    for (const ReferenceCase& one : manifest.cases) {
        const bool wanted =
            options.only.empty() ||
            std::any_of(options.only.begin(), options.only.end(),
                        [&](const std::string& pattern) { return fits(one.name, pattern); });
        if (!wanted) continue;
        CaseResult result;
        result.declared = one;
        result.seed = options.seed.value_or(one.seed);
        if (result.seed == one.reference_seed) {
            user_error(
                "--seed {}: the reference of '{}' was rendered with it; its noise must be "
                "independent",
                result.seed, one.name);
        }
        chosen.push_back(std::move(result));
    }
    return chosen;
}

std::string today() {
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    gmtime_r(&now, &utc);
    char text[16];
    std::strftime(text, sizeof text, "%Y-%m-%d", &utc);
    return text;
}

}  // namespace

std::string_view status_word(CaseStatus status) {
    switch (status) {
        case CaseStatus::passed:
            return "passed";
        case CaseStatus::failed:
            return "failed";
        case CaseStatus::weak:
            return "weak";
        case CaseStatus::missing:
            return "missing";
        case CaseStatus::error:
            return "error";
        case CaseStatus::skipped:
            break;
    }
    return "skipped";
}

size_t RegressResult::count(CaseStatus status) const {
    return static_cast<size_t>(
        std::count_if(cases.begin(), cases.end(),
                      [&](const CaseResult& result) { return result.status == status; }));
}

size_t RegressResult::failed() const {
    return cases.size() - count(CaseStatus::passed) - count(CaseStatus::skipped);
}

std::vector<std::string> reference_channels(bool stokes) {
    if (!stokes) return {"R", "G", "B"};
    std::vector<std::string> names;
    for (int i = 0; i < 4; ++i) {
        for (const char colour : {'R', 'G', 'B'}) names.push_back(fmt::format("S{}.{}", i, colour));
    }
    return names;
}

RegressResult run_regress(const ReferenceManifest& manifest, const RegressOptions& options) {
    const Clock::time_point start = Clock::now();
    RegressResult run;
    run.alpha = manifest.alpha;
    // The share of one case of all that the manifest lists, chosen or not: a single case is judged
    // as in the whole run.
    run.alpha_each = sidak_each(manifest.alpha, static_cast<double>(manifest.cases.size()));
    run.cases = chosen_cases(manifest, options);
    // The longest first, so that none of them is left for the end.
    std::vector<size_t> order(run.cases.size());
    for (size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
        return run.cases[a].declared.samples > run.cases[b].declared.samples;
    });
    Progress progress("regress", run.cases.size(), options.quiet);
    parallel_for(run.cases.size(), options.threads, [&](size_t k) {
        CaseResult& result = run.cases[order[k]];
        const ReferenceCase& one = result.declared;
        // Another name than the reference's, wherever the commands are run.
        result.render_command = render_command(manifest.scene_path(one), one, one.samples,
                                               result.seed, one.name + "-new.exr");
        result.compare_command =
            fmt::format("drude compare {}-new.exr {} --channels {} --alpha {} --any-scene",
                        one.name, quoted(manifest.reference_path(one)),
                        one.stokes ? "S0,S1,S2,S3" : "R,G,B", format_double(run.alpha_each));
        result.update_command = fmt::format("drude regress {} --only {} --update --why 'REASON'",
                                            quoted(manifest.folder), one.name);
        if (interrupted()) return;
        const Clock::time_point case_start = Clock::now();
        try {
            run_case(manifest, run.alpha_each, &result);
        } catch (const Error& error) {
            result.status = CaseStatus::error;
            result.message = error.message();
            result.cause = error.cause();
        }
        result.seconds = seconds_since(case_start);
        progress.step();
    });
    run.seconds = seconds_since(start);
    return run;
}

void update_reference(const ReferenceManifest& manifest, ReferenceCase* one, const std::string& why,
                      int threads, bool quiet) {
    const Scene scene = prepared_scene(manifest, *one);
    RenderResult rendered =
        render_case(scene, *one, one->reference_samples, one->reference_seed, threads, quiet);
    if (rendered.interrupted) {
        throw Error(Cause::user,
                    fmt::format("{}: interrupted; its reference stays as it was", one->name));
    }
    if (const std::string defects = defects_of(rendered); !defects.empty()) {
        throw Error(Cause::user,
                    fmt::format("{}: {}; its reference stays as it was", one->name, defects));
    }
    Image& image = rendered.image;
    if (one->stokes) {
        // R, G, B are S0 once more.
        const auto twice = [](const Channel& channel) {
            return channel.name.size() == 1 ||
                   (channel.name.rfind("variance.", 0) == 0 && channel.name.size() == 10);
        };
        image.channels.erase(std::remove_if(image.channels.begin(), image.channels.end(), twice),
                             image.channels.end());
    }
    const std::string path = manifest.reference_path(*one);
    // As from the manifest's folder: where that stands is no property of the picture.
    image.attributes["commandLine"] =
        render_command(one->scene, *one, one->reference_samples, one->reference_seed,
                       std::filesystem::path(path).filename().string());
    write_exr(path, image, Compression::piz);
    one->history.push_back({today(), DRUDE_VERSION, why});
}

}  // namespace drude
