// drude view: pictures of polarisation from a finished picture.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <memory>

#include "base/error.h"
#include "base/numbers.h"
#include "cli/command_list.h"
#include "cli/json_output.h"
#include "image/analyser.h"
#include "image/difference.h"
#include "image/polarisation_view.h"
#include "image/tonemap.h"

namespace drude {

namespace {

struct Options {
    std::string input, output, show;
    double wavelength_nm = 0.0, range = 0.0;
};

// What the options ask for, checked before files are read.
struct Request {
    PolarisationView view = PolarisationView::dop;
    std::optional<Analyser> analyser;  // where this is shown instead
    std::optional<double> wavelength_nm, range;
    bool layers = false;  // the analyser's layers as .exr
};

const std::map<std::string, PolarisationView>& views() {
    static const std::map<std::string, PolarisationView> all = {
        {"dop", PolarisationView::dop},   {"dolp", PolarisationView::dolp},
        {"docp", PolarisationView::docp}, {"aolp", PolarisationView::aolp},
        {"s0", PolarisationView::s0},     {"s1", PolarisationView::s1},
        {"s2", PolarisationView::s2},     {"s3", PolarisationView::s3}};
    return all;
}

void read_show(const std::string& show, Request& request) {
    const char* expected = "expected dop, dolp, docp, aolp, s0, s1, s2, s3 or analyser=ANGLE";
    if (show.empty()) user_error("view: nothing to show; {}, with --show", expected);
    const size_t equals = show.find('=');
    const std::string word = show.substr(0, equals);
    if (word == "analyser") {
        if (equals == std::string::npos) {
            user_error("--show analyser: without an angle; expected e.g. --show analyser=45");
        }
        request.analyser = parse_analyser(show.substr(equals + 1), "--show analyser");
        return;
    }
    const auto found = views().find(word);
    if (found == views().end() || equals != std::string::npos) {
        std::vector<std::string> words = {"analyser"};
        for (const auto& view : views()) words.push_back(view.first);
        const bool known = found != views().end();
        user_error("--show {}: {}{}", show, expected, known ? "" : did_you_mean(word, words));
    }
    request.view = found->second;
}

Request read_request(const Options& options, const OptionSet& given) {
    Request request;
    read_show(options.show, request);
    if (options.output.empty()) user_error("view: no output; name the picture with -o OUT.png");
    const std::string extension = std::filesystem::path(options.output).extension().string();
    request.layers = extension == ".exr";
    if (request.layers && !request.analyser) {
        user_error(
            "-o {}: only --show analyser=ANGLE writes layers; expected a name that ends in "
            ".png",
            options.output);
    }
    if (!request.layers && extension != ".png") {
        user_error("-o {}: expected a name that ends in .png{}", options.output,
                   request.analyser ? ", or in .exr for the layers" : "");
    }
    if (given.given("--wavelength")) {
        if (!(options.wavelength_nm > 0.0) || !std::isfinite(options.wavelength_nm)) {
            user_error("--wavelength {}: expected nanometres above 0, e.g. 550",
                       options.wavelength_nm);
        }
        request.wavelength_nm = options.wavelength_nm;
    }
    if (given.given("--range")) {
        if (!(options.range > 0.0) || !std::isfinite(options.range)) {
            user_error("--range {}: expected a number above 0, the upper end of the scale",
                       options.range);
        }
        if (request.analyser || request.view == PolarisationView::aolp) {
            user_error("--range: {} has none to choose; leave it out",
                       request.analyser ? "the picture behind an analyser"
                                        : "the angle of polarisation, from 0 to 180 degrees,");
        }
        request.range = options.range;
    }
    return request;
}

std::string layer_words(const LayerChoice& choice, const Request& request) {
    if (!choice.wavelength_nm) return "Y of the colours";
    const std::string nm = format_double(*choice.wavelength_nm);
    if (choice.wavelength_nm == request.wavelength_nm) return nm + " nm";
    return fmt::format("{} nm, the layer nearest to {} nm", nm,
                       format_double(*request.wavelength_nm));
}

nlohmann::ordered_json common_json(const Options& options, const Image& image,
                                   const LayerChoice& choice) {
    nlohmann::ordered_json json = {
        {"input", options.input},   {"output", options.output},
        {"show", options.show},     {"layer", choice.suffix},
        {"wavelength_nm", nullptr}, {"width", image.width},
        {"height", image.height},   {"left_handed", is_left_handed(image)}};
    if (choice.wavelength_nm) json["wavelength_nm"] = *choice.wavelength_nm;
    return json;
}

// Over the pixels with a value: components plainly, degrees weighted by S0, so that they are those
// of all the light together. An angle has no mean.
std::optional<double> mean_value(const StokesLayer& layer, PolarisationView view,
                                 const std::vector<double>& values) {
    if (view == PolarisationView::aolp) return std::nullopt;
    double sum = 0.0, weights = 0.0;
    for (size_t i = 0; i < values.size(); ++i) {
        if (std::isnan(values[i])) continue;
        const double weight = view >= PolarisationView::s0 ? 1.0 : layer.s[0][i];
        sum += weight * values[i];
        weights += weight;
    }
    if (!(weights > 0.0)) return std::nullopt;
    return sum / weights;
}

int show_figure(const Options& options, const Request& request, const Image& image, bool json) {
    const LayerChoice choice = choose_layer(image, options.input, request.wavelength_nm);
    const StokesLayer layer =
        read_stokes_layer(image, options.input, choice, needs_s3(request.view));
    const std::vector<double> values = view_values(layer, request.view);
    const ColourBar bar = view_bar(request.view, values, request.range);
    const Picture picture = with_colour_bar(view_picture(layer, request.view, values, bar), bar);
    write_png(options.output, picture.width, picture.height, picture.rgb);
    size_t without = 0;
    for (const double value : values) without += std::isnan(value) ? 1 : 0;
    const std::optional<double> mean = mean_value(layer, request.view, values);
    if (json) {
        nlohmann::ordered_json document = common_json(options, image, choice);
        document["low"] = bar.low;
        document["high"] = bar.high;
        document["mean"] = nullptr;
        if (mean) document["mean"] = *mean;
        document["pixels"] = values.size();
        document["pixels_without_value"] = without;
        print_json_document(document);
        return 0;
    }
    fmt::print("{}: {} of {}, {}\n", options.output, options.show, options.input,
               layer_words(choice, request));
    fmt::print("  scale from {} to {}{}\n", format_double(bar.low), format_double(bar.high),
               request.view == PolarisationView::aolp
                   ? fmt::format(" degrees, full colour from DoLP {}", full_colour_dolp)
                   : "");
    if (mean) fmt::print("  mean {:.6g}\n", *mean);
    if (without > 0) {
        fmt::print("  {} of {} pixels have no value (grey)\n", without, values.size());
    }
    if (needs_s3(request.view) && is_left_handed(image)) {
        fmt::print("  the file counts S3 left-handed: its sign is changed\n");
    }
    return 0;
}

// The picture as a display shows it, with the tone mapping of the picture without the filter:
// pictures behind different analysers compare, and none of them clips what the plain one shows.
std::vector<float> shown(const Image& analysed, const Image& image, const Options& options,
                         const std::vector<std::string>& layers, int threads) {
    Image bare;
    bare.width = image.width;
    bare.height = image.height;
    for (const std::string& suffix : layers) {
        const bool colour = suffix == "R" || suffix == "G" || suffix == "B";
        if (!colour && layers.size() > 1) continue;
        bare.add(colour ? suffix : "Y").data = image.at("S0." + suffix, options.input).data;
    }
    DurandOptions durand;
    durand.threads = threads;
    const DurandParameters parameters =
        durand_parameters(image.width, image.height, rgb_values(bare, options.input), durand);
    return tonemap_durand(image.width, image.height, rgb_values(analysed, options.input),
                          parameters, durand);
}

int show_analysed(const Options& options, const Request& request, const Image& image,
                  const CommonOptions& common) {
    const LayerChoice choice = choose_layer(image, options.input, request.wavelength_nm);
    const std::vector<std::string> layers =
        analysed_layers(image, options.input, request.wavelength_nm);
    const Image analysed = behind_analyser(image, options.input, layers, *request.analyser);
    if (request.layers) {
        write_exr(options.output, analysed, Compression::piz);
    } else {
        write_png(options.output, image.width, image.height,
                  shown(analysed, image, options, layers, common.threads));
    }
    const StokesLayer before = read_stokes_layer(image, options.input, choice, false);
    const StokesLayer after = read_stokes_layer(analysed, options.output, choice, false);
    const auto light = [](const StokesLayer& layer) {
        double sum = 0.0;
        for (const double s0 : layer.s[0]) sum += std::isfinite(s0) ? s0 : 0.0;
        return sum;
    };
    const double all = light(before);
    const std::optional<double> passed =
        all > 0.0 ? std::optional<double>(light(after) / all) : std::nullopt;
    if (common.json) {
        nlohmann::ordered_json document = common_json(options, image, choice);
        document["analyser"] = format_analyser(*request.analyser);
        document["passed"] = nullptr;
        if (passed) document["passed"] = *passed;
        print_json_document(document);
        return 0;
    }
    fmt::print("{}: {} behind a linear polariser at {} degrees", options.output, options.input,
               format_double(request.analyser->axis_deg));
    if (const auto& retarder = request.analyser->retarder) {
        fmt::print(" and, before it, a retarder of {} degrees with its fast axis at {} degrees",
                   format_double(retarder->retardance_deg), format_double(retarder->fast_axis_deg));
    }
    fmt::print("\n  {}", layer_words(choice, request));
    if (passed) fmt::print(": {:.6g} of the light passes", *passed);
    fmt::print("\n");
    if (request.analyser->retarder && is_left_handed(image)) {
        fmt::print("  the file counts S3 left-handed: its sign is changed\n");
    }
    return 0;
}

}  // namespace

Command view_command() {
    Command command;
    command.name = "view";
    command.summary = "Show the polarisation of a finished picture";
    command.description =
        "Reads an OpenEXR picture with Stokes layers and writes what --show names as a PNG with "
        "its scale. With --wavelength it is taken from the nearest spectral layer, otherwise from "
        "Y of the colours. S1 > 0 is horizontal in the picture, S2 > 0 at 45 degrees from right "
        "towards up, S3 > 0 clockwise seen looking towards the source.\n\n"
        "  dop    degree of polarisation, sqrt(S1^2 + S2^2 + S3^2)/S0\n"
        "  dolp   degree of linear polarisation, sqrt(S1^2 + S2^2)/S0\n"
        "  docp   degree of circular polarisation, |S3|/S0\n"
        "  aolp   angle of linear polarisation, 0 to 180 degrees, counter-clockwise from\n"
        "         the horizontal; fades to grey where DoLP is below 0.1\n"
        "  s0     radiance\n"
        "  s1, s2, s3\n"
        "         the signed component: blue below 0, orange above\n"
        "  analyser=ANGLE\n"
        "         the picture behind a linear polariser that passes light along ANGLE\n"
        "  analyser=ANGLE,retarder=FAST[:RETARDANCE]\n"
        "         with a retarder before it whose fast axis is at FAST; a quarter-wave\n"
        "         plate unless RETARDANCE says other than 90 degrees\n\n"
        "The analyser analyser=0,retarder=-45 passes light of S3 > 0 whole and none of S3 < 0.\n\n"
        "Grey is where there is nothing to show: no light, or no direction. The scale of s0 to s3 "
        "reaches what 99.5 % of the pixels stay within, that of the degrees 1; --range sets "
        "another, so that pictures compare. Degrees of Y can exceed 1 where colours are outside "
        "Rec.709.\n\n"
        "Behind an analyser the PNG is tone-mapped like the picture without it, so that pictures "
        "at "
        "different angles compare; an output that ends in .exr gets the linear "
        "layers instead, R, G, B and S0 to S3 of every layer. 'passed' in the JSON is the part of "
        "S0 that comes through.\n\n"
        "Stokes layers of other renderers are read as they are (Mitsuba's S0.R, the spectral "
        "layers of ART): the signs are those of the file, except that S3 of a file that says "
        "polarisationHandedness \"left\" is turned round.";
    command.example =
        "drude render scenes/half-sphere.pbrt --environment courtyard --stokes --spectral -o "
        "a.exr\n"
        "drude view a.exr --show aolp -o aolp.png\n"
        "drude view a.exr --show s3 --wavelength 550 -o s3.png\n"
        "drude view a.exr --show analyser=90 -o vertical.png\n"
        "drude view a.exr --show analyser=0,retarder=-45 -o right-handed.exr";
    command.declare = [](OptionSet& set, const CommonOptions& common) {
        const auto options = std::make_shared<Options>();
        set.positional("IN", options->input, "The picture, an .exr with Stokes layers.", true);
        set.option("--show", options->show,
                   "dop, dolp, docp, aolp, s0, s1, s2, s3 or analyser=ANGLE[,retarder=...].");
        set.option("-o,--output", options->output, "The PNG to write, or .exr of an analyser.");
        set.option("--wavelength", options->wavelength_nm,
                   "Nanometres: show the nearest spectral layer.");
        set.option("--range", options->range, "Upper end of the scale.");
        return [options, &set, &common] {
            const Request request = read_request(*options, set);
            const Image image = read_image(options->input);
            return request.analyser ? show_analysed(*options, request, image, common)
                                    : show_figure(*options, request, image, common.json);
        };
    };
    return command;
}

}  // namespace drude
