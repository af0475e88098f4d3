// The only source that knows OpenImageIO; built into drude-oiio.so and loaded on first need.
#include "image/oiio/oiio_module.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cstdlib>
#include <exception>
#include <memory>
#include <string>
#include <vector>

namespace {

void say(char* message, size_t size, const std::string& text) {
    const size_t count = text.copy(message, size - 1);
    message[count] = '\0';
}

std::string read(const char* path, unsigned long long most_pixels, DrudeOiioPicture& picture) {
    OIIO::ImageSpec wishes;
    wishes.attribute("oiio:UnassociatedAlpha", 1);
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path, &wishes);
    if (!input) {
        const std::string reason = OIIO::geterror();
        return reason.empty() ? "no format that OpenImageIO reads" : reason;
    }
    const OIIO::ImageSpec& spec = input->spec();
    if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.nchannels < 1 ||
        spec.nchannels > 4) {
        return "holds " + std::to_string(spec.width) + " x " + std::to_string(spec.height) +
               " pixels of " + std::to_string(spec.nchannels) +
               " channels; expected a flat picture of 1 to 4 channels";
    }
    const auto width = static_cast<unsigned long long>(spec.width);
    const auto height = static_cast<unsigned long long>(spec.height);
    if (width > most_pixels / height)
        return "larger than " + std::to_string(most_pixels) + " pixels";
    picture.width = spec.width;
    picture.height = spec.height;
    picture.channels = spec.nchannels;
    picture.is_integer = spec.format.is_floating_point() ? 0 : 1;
    const size_t count = static_cast<size_t>(width * height) * static_cast<size_t>(spec.nchannels);
    picture.values = static_cast<float*>(std::malloc(count * sizeof(float)));
    if (!picture.values) return "does not fit into memory";
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, picture.values)) {
        const std::string reason = input->geterror();
        return reason.empty() ? "damaged or truncated" : reason;
    }
    return "";
}

std::string encode(int width, int height, const unsigned char* rgb,
                   std::vector<unsigned char>& bytes) {
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("memory.png");
    if (!output) return OIIO::geterror();
    OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    // No date: the same picture is the same bytes.
    spec.attribute("png:compressionLevel", 6);
    if (!output->set_ioproxy(&memory)) return "this OpenImageIO cannot write PNG to memory";
    if (!output->open("memory.png", spec) || !output->write_image(OIIO::TypeDesc::UINT8, rgb) ||
        !output->close()) {
        return output->geterror();
    }
    return "";
}

}  // namespace

extern "C" {

int drude_oiio_version() {
    return drude_oiio_interface;
}

int drude_oiio_read(const char* path, unsigned long long most_pixels, DrudeOiioPicture* picture) {
    *picture = DrudeOiioPicture{};
    std::string failure;
    try {
        failure = read(path, most_pixels, *picture);
    } catch (const std::exception& error) {
        failure = error.what();
    } catch (...) {
        failure = "unknown failure inside OpenImageIO";
    }
    if (failure.empty()) return 0;
    drude_oiio_release(picture);
    say(picture->message, sizeof picture->message, failure);
    return 1;
}

void drude_oiio_release(DrudeOiioPicture* picture) {
    std::free(picture->values);
    picture->values = nullptr;
}

int drude_oiio_png(int width, int height, const unsigned char* rgb, DrudeOiioSink sink,
                   void* context, char* message, size_t message_size) {
    std::string failure;
    std::vector<unsigned char> bytes;
    try {
        failure = encode(width, height, rgb, bytes);
        if (failure.empty() && bytes.empty()) failure = "OpenImageIO wrote nothing";
    } catch (const std::exception& error) {
        failure = error.what();
    } catch (...) {
        failure = "unknown failure inside OpenImageIO";
    }
    if (!failure.empty()) {
        say(message, message_size, failure);
        return 1;
    }
    sink(context, bytes.data(), bytes.size());
    return 0;
}
}
