// drude compare: are two pictures the same, and if not, where and by how much.
#include "image/compare.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>

#include "base/error.h"
#include "base/numbers.h"
#include "cli/command_list.h"
#include "cli/compare_output.h"
#include "cli/json_output.h"
#include "image/difference.h"
#include "image/sheet.h"
#include "image/tonemap.h"

namespace drude {

namespace {

struct Options {
    std::string a, b, output, pair, channels, tolerance, range, flip = "none";
    bool exact = false, any_scene = false, log = false, is_signed = false, z_map = false;
    double alpha = 1e-3;
};

void read_range(const std::string& text, ColourBar& bar) {
    const size_t comma = text.find(',');
    const std::optional<double> low = parse_double(text.substr(0, comma));
    const std::optional<double> high =
        comma == std::string::npos ? std::nullopt : parse_double(text.substr(comma + 1));
    if (!low || !high || !std::isfinite(*low) || !std::isfinite(*high) || !(*low < *high)) {
        user_error("--range '{}': expected LOW,HIGH with LOW below HIGH, e.g. -5,0", text);
    }
    bar.low = *low;
    bar.high = *high;
}

void write_difference(const Image& a, const Image& b, const Comparison& comparison,
                      const Options& options, const ColourBar& bar) {
    if (std::filesystem::path(options.output).extension() == ".exr") {
        Image difference;
        difference.width = a.width;
        difference.height = a.height;
        for (const std::string& name : comparison.channels) {
            Channel& channel = difference.add(name);
            const Channel& in_a = a.at(name, options.a);
            const Channel& in_b = b.at(name, options.b);
            for (size_t i = 0; i < channel.data.size(); ++i) {
                channel.data[i] = in_a.data[i] - in_b.data[i];
            }
        }
        write_exr(options.output, difference, Compression::zip);
        return;
    }
    const std::vector<double> values =
        options.z_map ? standard_error_difference(a, b, comparison.channels, options.a, options.b)
        : options.is_signed ? signed_difference(a, b, comparison.figure_channels)
                            : log_difference(a, b, comparison.figure_channels);
    const Picture picture = with_colour_bar(map_values(a.width, a.height, values, bar), bar);
    write_png(options.output, picture.width, picture.height, picture.rgb);
}

// Both pictures side by side under the tone mapping that the reference decides: an operator that
// adapted to each would make up differences and hide others.
void write_pair(const Image& a, const Image& b, const Options& options, int threads) {
    const std::vector<float> rgb_a = rgb_values(a, options.a), rgb_b = rgb_values(b, options.b);
    DurandOptions durand;
    durand.threads = threads;
    const DurandParameters parameters = durand_parameters(b.width, b.height, rgb_b, durand);
    const auto shown = [&](const Image& image, const std::vector<float>& rgb) {
        Picture picture(image.width, image.height, {});
        picture.rgb = tonemap_durand(image.width, image.height, rgb, parameters, durand);
        return picture;
    };
    Sheet sheet;
    sheet.row_captions = {""};
    sheet.column_captions = {"A", "B"};  // as on the command line: names would not fit
    sheet.cells = {{shown(a, rgb_a), shown(b, rgb_b)}};
    const Picture picture = compose_sheet(sheet);
    write_png(options.pair, picture.width, picture.height, picture.rgb);
}

std::optional<FlipResult> flip_of(const Image& a, const Image& b, const Options& options,
                                  int threads) {
    if (options.flip == "none") return std::nullopt;
    const auto picture = [](const Image& image, const std::string& name) {
        Picture result(image.width, image.height, {});
        result.rgb = rgb_values(image, name);
        return result;
    };
    FlipOptions flip;
    flip.threads = threads;
    const Picture in_a = picture(a, options.a), in_b = picture(b, options.b);
    return options.flip == "hdr" ? flip_hdr(in_a, in_b, flip) : flip_ldr(in_a, in_b, flip);
}

bool same_file(const std::string& a, const std::string& b) {
    std::error_code no_a, no_b;
    // Absolute first: a relative name that does not exist would stay relative.
    const auto path_a = std::filesystem::weakly_canonical(std::filesystem::absolute(a), no_a);
    const auto path_b = std::filesystem::weakly_canonical(std::filesystem::absolute(b), no_b);
    // What cannot be resolved cannot be written either; its own error comes later.
    return no_a || no_b ? a == b : path_a == path_b;
}

// No result takes the place of a picture that was given, or of the other result.
void check_outputs(const Options& options) {
    const std::pair<const char*, const std::string*> outputs[] = {{"-o", &options.output},
                                                                  {"--pair", &options.pair}};
    for (const auto& [option, output] : outputs) {
        if (output->empty()) continue;
        for (const std::string* input : {&options.a, &options.b}) {
            if (same_file(*output, *input)) {
                user_error("{} {}: is a picture that is compared; name another file", option,
                           *output);
            }
        }
    }
    if (!options.output.empty() && !options.pair.empty() &&
        same_file(options.output, options.pair)) {
        user_error("-o {} and --pair {}: are one file; name two", options.output, options.pair);
    }
}

// Everything that can be wrong with the options alone, before files are read.
ColourBar check(const Options& options) {
    if (options.exact && !options.tolerance.empty()) {
        user_error("--exact and --tolerance: choose one");
    }
    if (static_cast<int>(options.log) + static_cast<int>(options.is_signed) +
            static_cast<int>(options.z_map) >
        1) {
        user_error("--log, --signed and --z-map: choose one");
    }
    if (!options.pair.empty() && std::filesystem::path(options.pair).extension() != ".png") {
        user_error("--pair {}: expected a name that ends in .png", options.pair);
    }
    if (options.output.empty()) {
        const char* needs = options.log              ? "--log"
                            : options.is_signed      ? "--signed"
                            : options.z_map          ? "--z-map"
                            : !options.range.empty() ? "--range"
                                                     : nullptr;
        if (needs)
            user_error("{}: describes the difference picture; name it with -o DIFF.png", needs);
    } else {
        const std::string extension = std::filesystem::path(options.output).extension().string();
        if (extension != ".png" && extension != ".exr") {
            user_error("-o {}: expected a name that ends in .png (colours) or .exr (a - b)",
                       options.output);
        }
    }
    if (!(options.alpha > 0.0) || !(options.alpha < 1.0)) {
        user_error("--alpha {}: expected a probability between 0 and 1, e.g. 0.001", options.alpha);
    }
    check_outputs(options);
    ColourBar bar = options.z_map       ? standard_error_bar()
                    : options.is_signed ? signed_difference_bar()
                                        : log_difference_bar();
    if (!options.range.empty()) read_range(options.range, bar);
    return bar;
}

int run(const Options& options, const CommonOptions& common) {
    const ColourBar bar = check(options);
    CompareOptions compare;
    compare.exact = options.exact;
    compare.any_scene = options.any_scene;
    compare.alpha = options.alpha;
    compare.threads = common.threads;
    if (!options.tolerance.empty()) compare.tolerance = parse_tolerance(options.tolerance);
    const Image a = read_image(options.a);
    const Image b = read_image(options.b);
    if (!options.channels.empty()) {
        compare.channels = parse_channels(options.channels, a, options.a);
    }
    const Comparison comparison = compare_images(a, b, options.a, options.b, compare);
    if (!options.output.empty()) {
        write_difference(a, b, comparison, options, bar);
    }
    if (!options.pair.empty()) write_pair(a, b, options, common.threads);
    const std::optional<FlipResult> flip = flip_of(a, b, options, common.threads);
    const CompareWords words = {options.a, options.b, options.flip, options.alpha};
    if (common.json) {
        print_json_document(comparison_json(comparison, flip, words));
    } else {
        print_comparison(comparison, flip, words);
    }
    return comparison.same ? 0 : static_cast<int>(Cause::answer_is_no);
}

}  // namespace

Command compare_command() {
    Command command;
    command.name = "compare";
    command.summary = "Compare two pictures, with their noise taken into account";
    command.description =
        "Compares A with B (the reference) and exits with 0 where they count as the same, 1 where "
        "they differ, 2 where they cannot be compared (other size, missing channel, bad file).\n\n"
        "What decides: with --exact, all channels and their names, bit for bit; with --tolerance "
        "ABS,REL,PERCENT, at most PERCENT % of the values may be further apart than the larger of "
        "ABS and REL times the value. Otherwise, where both files hold the variances between "
        "batches that 'drude render' writes, Welch's test on pixels, on 8x8 blocks and on the "
        "mean, "
        "at a false-alarm probability of --alpha for the whole comparison; where they do not, only "
        "equal values are the same. The smallest detectable bias says what such a test could have "
        "seen: a mean difference of that size is revealed with 95 % probability.\n\n"
        "Pictures of different sizes, of different scenes (attribute sceneHash; --any-scene "
        "allows it), with other channels or with spectral layers of other wavelengths are errors "
        "of their own.\n\n"
        "What is compared unless --channels says so: R, G, B (or Y), and S1 to S3 where both files "
        "have them, for light can change its polarisation and keep its colour. The figures and "
        "the pictures of --log and --signed are of R, G, B alone then.\n\n"
        "Figures (null in JSON where no value is finite in both): mean error (a - b), mean "
        "absolute error, RMSE, relative MSE "
        "((a - b)^2 / (b^2 + 0.01)), SMAPE, PSNR (peak: largest |b|), largest error; --flip adds "
        "FLIP (Andersson et al. 2020, at 67 pixels a degree; hdr: 2021, the worst of many "
        "exposures). Where both files have S0 to S3: their errors one by one, and those of the "
        "degree and the angle of linear polarisation, weighted by the polarised intensity, per "
        "wavelength or from Y.\n\n"
        "-o DIFF.png draws log10 of the mean over the channels of |a - b| from -5 to 0 (--log, the "
        "default), the mean of a - b from -0.1 to 0.1 (--signed), or a - b in standard errors of "
        "the channel furthest off from -6 to 6 (--z-map), with a colour bar; --range "
        "sets another range. Magenta marks what is no number. -o DIFF.exr writes a - b itself. "
        "--pair OUT.png sets both pictures side by side under one tone mapping, that of B.\n\n"
        "Files of pbrt-v4, Mitsuba and ART are read as they are: R, G, B, S0.R to S3.B and "
        "S0.550,000000nm are the same names there. Mitsuba's scenes are right-handed; signs of "
        "S2 and S3 agree only where the scene was mirrored.";
    command.example =
        "drude compare fitted.exr literature.exr --log -o difference.png\n"
        "drude compare new.exr reference.exr --json\n"
        "drude compare new.exr old.exr --flip hdr --pair pair.png\n"
        "drude compare one.exr two.exr --channels S1,S2 --tolerance 1e-5,1e-3,0.1";
    command.declare = [](OptionSet& set, const CommonOptions& common) {
        const auto options = std::make_shared<Options>();
        set.positional("A", options->a, "The picture in question.", true);
        set.positional("B", options->b, "The reference.", true);
        set.flag("--exact", options->exact, "Compare pixels and channel names bit for bit.");
        set.flag("--any-scene", options->any_scene,
                 "Compare pictures whose files say that they show different scenes.");
        set.option("--tolerance", options->tolerance,
                   "ABS,REL,PERCENT: the difference that is allowed.");
        set.option("--alpha", options->alpha, "Probability of a false alarm of the noise test.");
        set.option("--channels", options->channels,
                   "Channels, layers (S1 for S1.*) or 'all'; R,G,B and S1 to S3 unless given.");
        set.flag("--log", options->log, "Draw log10 |a - b|, the default.");
        set.flag("--signed", options->is_signed, "Draw a - b.");
        set.flag("--z-map", options->z_map, "Draw (a - b) / standard error.");
        set.option("--pair", options->pair, "Write A and B side by side, tone-mapped alike, .png.");
        set.choice("--flip", options->flip, {"none", "ldr", "hdr"},
                   "Compute FLIP, of what a display shows or over all exposures.");
        set.option("--range", options->range, "LOW,HIGH: what the ends of the colours stand for.");
        set.option("-o,--output", options->output, "Write the difference picture, .png or .exr.");
        return [options, &common] { return run(*options, common); };
    };
    return command;
}

}  // namespace drude
