// drude tonemap: linear pictures made fit for a display.
#include "image/tonemap.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "cli/command_list.h"
#include "cli/json_output.h"
#include "image/image.h"

namespace drude {

namespace {

struct Options {
    std::string input, output, like;
    std::string operator_name = "durand";
    double contrast = 50.0;
    double exposure = 0.0;
};

void check(const Options& options, const OptionSet& given) {
    if (options.output.empty()) user_error("tonemap: no output; name the picture with -o OUT.png");
    if (std::filesystem::path(options.output).extension() != ".png") {
        user_error("-o {}: expected a name that ends in .png", options.output);
    }
    if (!std::isfinite(options.contrast) || options.contrast <= 1.0) {
        user_error("--contrast {}: expected a number above 1, e.g. 50", options.contrast);
    }
    if (!std::isfinite(options.exposure) || std::abs(options.exposure) > 100.0) {
        user_error("--exposure {}: expected stops between -100 and 100", options.exposure);
    }
    if (options.operator_name == "linear") {
        if (given.given("--like"))
            user_error("--like: only the operator durand adapts to a picture");
        if (given.given("--contrast")) user_error("--contrast: only the operator durand has one");
    }
}

int run(const Options& options, const CommonOptions& common) {
    const Image image = read_image(options.input);
    std::vector<float> rgb = rgb_values(image, options.input);
    nlohmann::json json = {{"output", options.output},
                           {"operator", options.operator_name},
                           {"exposure", options.exposure},
                           {"width", image.width},
                           {"height", image.height}};
    if (options.operator_name == "durand") {
        DurandOptions durand;
        durand.contrast = options.contrast;
        durand.threads = common.threads;
        DurandParameters parameters;
        if (options.like.empty()) {
            parameters = durand_parameters(image.width, image.height, rgb, durand);
        } else {
            const Image other = read_image(options.like);
            parameters = durand_parameters(other.width, other.height,
                                           rgb_values(other, options.like), durand);
        }
        rgb = tonemap_durand(image.width, image.height, rgb, parameters, durand);
        json["compression"] = parameters.compression;
        json["max_base"] = parameters.max_base;
        json["like"] = options.like.empty() ? options.input : options.like;
    }
    write_png(options.output, image.width, image.height, expose(std::move(rgb), options.exposure));
    if (common.json) {
        print_json_document(json);
    } else if (json.contains("compression")) {
        fmt::print("{}: base contrast times {:.4g}, white at {:.4g}\n", options.output,
                   json["compression"].get<double>(),
                   std::pow(10.0, json["max_base"].get<double>()));
    } else {
        fmt::print("{}: linear, {:+g} stops\n", options.output, options.exposure);
    }
    return 0;
}

}  // namespace

Command tonemap_command() {
    Command command;
    command.name = "tonemap";
    command.summary = "Make a linear picture fit for a display";
    command.description =
        "Reads an OpenEXR picture (or any that OpenImageIO reads) and writes an 8-bit sRGB PNG.\n\n"
        "The operator 'durand' (Durand & Dorsey 2002) splits log10 intensity with a bilateral "
        "filter (2 % of the larger side, 0.4 in log10), compresses the large-scale contrast to "
        "--contrast and keeps detail and colour. The extent of the large scale is measured between "
        "its 0.1 % and 99.9 % percentiles, black pixels left out.\n\n"
        "Two pictures that are to be compared need one compression: --like takes it from the other "
        "picture. Differences are still to be taken on linear data, with 'drude compare'.\n\n"
        "The operator 'linear' only scales by 2^exposure and clips.";
    command.example =
        "drude tonemap fitted.exr -o fitted.png --like literature.exr\n"
        "drude tonemap literature.exr -o literature.png";
    command.declare = [](OptionSet& set, const CommonOptions& common) {
        const auto options = std::make_shared<Options>();
        set.positional("IN", options->input, "The picture, linear.", true);
        set.option("-o,--output", options->output, "The PNG to write.");
        set.choice("--operator", options->operator_name, {"durand", "linear"},
                   "How values become display values.");
        set.option("--like", options->like, "Take the compression from this picture.");
        set.option("--contrast", options->contrast, "Contrast of the large scale on the display.");
        set.option("--exposure", options->exposure, "Stops of exposure, after the operator.");
        return [options, &set, &common] {
            check(*options, set);
            return run(*options, common);
        };
    };
    return command;
}

}  // namespace drude
