// Texture "imagemap".
#include <algorithm>
#include <cctype>

#include "base/numbers.h"
#include "scene/builders.h"

namespace drude {

namespace {

// Whether a path ends so, in whatever case.
bool ends_with(std::string path, std::string_view end) {
    std::transform(path.begin(), path.end(), path.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return path.size() >= end.size() &&
           path.compare(path.size() - end.size(), end.size(), end) == 0;
}

// As pbrt-v4: PNG files are sRGB, everything else is linear where the scene does not say more.
void read_encoding(ImageTexture& image, ParameterList& list, BuildContext& context) {
    const bool is_png = ends_with(image.path, ".png");
    image.encoding = is_png ? ImageTexture::Encoding::srgb : ImageTexture::Encoding::linear;
    if (!list.has("encoding")) {
        const bool is_photo = ends_with(image.path, ".jpg") || ends_with(image.path, ".jpeg");
        if (is_photo) {
            context.messages.note(image.place,
                                  fmt::format("{}: taken as linear, as pbrt-v4 takes all pictures "
                                              "but PNG; \"string encoding\" \"sRGB\" changes that",
                                              list.owner()));
        }
        return;
    }
    const std::string encoding = list.text("encoding", "");
    if (encoding == "sRGB") {
        image.encoding = ImageTexture::Encoding::srgb;
    } else if (encoding == "linear") {
        image.encoding = ImageTexture::Encoding::linear;
    } else {
        const std::optional<double> gamma =
            encoding.rfind("gamma ", 0) == 0 ? parse_double(encoding.substr(6)) : std::nullopt;
        if (!gamma || !(*gamma > 0 && *gamma <= 100)) {
            user_error_at(list.place_of("encoding"),
                          "{}: encoding is '{}'{}; expected \"sRGB\", \"linear\" or \"gamma X\" "
                          "with X from 0 to 100",
                          list.owner(), shown(encoding),
                          did_you_mean(encoding, {"sRGB", "linear", "gamma 2.2"}));
        }
        image.encoding = ImageTexture::Encoding::gamma;
        image.gamma = *gamma;
    }
}

}  // namespace

ImageTexture build_image_texture(ParameterList& list, const glm::dmat4& world_from_texture,
                                 BuildContext& context) {
    ImageTexture image;
    if (!list.has("filename")) {
        user_error_at(list.place(), "{}: imagemap without \"string filename\"; expected a picture",
                      list.owner());
    }
    const std::string name = list.text("filename", "");
    image.place = list.place_of("filename");
    image.path = context.assets.find(name, image.place.file, image.place, "picture of a texture");
    context.assets.count(image.path, image.place);
    image.mapping = build_mapping(list, world_from_texture);
    const std::string wrap =
        list.choice("wrap", "repeat", {"repeat", "black", "clamp", "octahedralsphere"});
    if (wrap == "black") image.wrap = ImageTexture::Wrap::black;
    if (wrap == "clamp" || wrap == "octahedralsphere") image.wrap = ImageTexture::Wrap::clamp;
    if (wrap == "octahedralsphere") {
        context.messages.stand_in(
            list.place_of("wrap"),
            fmt::format("{}: wrap \"octahedralsphere\" is not modelled; \"clamp\" stands in",
                        list.owner()));
    }
    const std::string filter =
        list.choice("filter", "bilinear", {"point", "bilinear", "trilinear", "ewa", "EWA"});
    image.bilinear = filter != "point";
    if (filter != "point" && filter != "bilinear") {
        context.messages.note(
            list.place_of("filter"),
            fmt::format("{}: the picture is read bilinearly at its full resolution and the "
                        "samples of a pixel average it, instead of the filter \"{}\"",
                        list.owner(), filter));
    }
    if (list.has("maxanisotropy")) list.number("maxanisotropy", 8);
    image.scale = list.number("scale", 1);
    image.invert = list.boolean("invert", false);
    read_encoding(image, list, context);
    return image;
}

}  // namespace drude
