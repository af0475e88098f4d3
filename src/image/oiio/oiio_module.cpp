// The only source that knows OpenImageIO; built into drude-oiio.so and loaded on first need.
#include "image/oiio/oiio_module.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagecache.h>
#include <OpenImageIO/imageio.h>

#include <cstdlib>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
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

// One cache of its own for all textures, up to the end of the process: handles stay good.
struct TextureCache {
    decltype(OIIO::ImageCache::create(false)) cache = OIIO::ImageCache::create(false);

    TextureCache() {
        cache->attribute("max_memory_MB", 1024.0f);
        cache->attribute("max_open_files", 100);
        // Pictures without tiles are kept in squares, too.
        cache->attribute("autotile", 64);
        cache->attribute("unassociatedalpha", 1);
    }
};
TextureCache& textures() {
    static TextureCache* cache = new TextureCache;
    return *cache;
}

struct OpenTexture {
    OIIO::ImageCache::ImageHandle* file;
    int x, y;  // of its first pixel
    int channels;
};

// The cache's message, which names the file, without line breaks.
std::string cache_error(const std::string& otherwise) {
    std::string reason = textures().cache->geterror();
    if (reason.empty()) return otherwise;
    while (!reason.empty() && reason.back() == '\n') reason.pop_back();
    for (char& c : reason) {
        if (c == '\n') c = ' ';
    }
    return reason;
}

std::string open_texture(const char* path, unsigned long long most_pixels,
                         DrudeOiioTexture& texture) {
    static std::mutex mutex;
    static std::deque<OpenTexture> opened;
    const auto& cache = textures().cache;
    // A file of this name may have been another one before.
    cache->invalidate(OIIO::ustring(path), false);
    auto* file = cache->get_image_handle(OIIO::ustring(path));
    OIIO::ImageSpec spec;
    if (!file || !cache->good(file) || !cache->get_imagespec(file, nullptr, spec)) {
        return cache_error("no format that OpenImageIO reads");
    }
    if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.nchannels < 1 || spec.deep) {
        return "holds " + std::to_string(spec.width) + " x " + std::to_string(spec.height) +
               " pixels; expected a flat picture";
    }
    const auto width = static_cast<unsigned long long>(spec.width);
    if (width > most_pixels / static_cast<unsigned long long>(spec.height)) {
        return "larger than " + std::to_string(most_pixels) + " pixels";
    }
    texture.width = spec.width;
    texture.height = spec.height;
    texture.channels = spec.nchannels >= 3 ? 3 : 1;
    texture.is_integer = spec.format.is_floating_point() ? 0 : 1;
    const std::lock_guard<std::mutex> lock(mutex);
    opened.push_back({file, spec.x, spec.y, texture.channels});
    texture.handle = &opened.back();
    return "";
}

// This thread's part of the cache, asked for once: OpenImageIO looks it up at every call otherwise.
// Threads enrol one at a time, under a lock that a race detector sees.
OIIO::ImageCache::Perthread* this_threads_part() {
    static std::mutex mutex;
    thread_local OIIO::ImageCache::Perthread* part = [] {
        const std::lock_guard<std::mutex> lock(mutex);
        return textures().cache->get_perthread_info();
    }();
    return part;
}

std::string read_texels(const OpenTexture& texture, int x0, int x1, int y0, int y1, float* values) {
    const bool done = textures().cache->get_pixels(
        texture.file, this_threads_part(), 0, 0, texture.x + x0, texture.x + x1, texture.y + y0,
        texture.y + y1, 0, 1, 0, texture.channels, OIIO::TypeDesc::FLOAT, values);
    return done ? "" : cache_error("damaged or truncated");
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

int drude_oiio_texture(const char* path, unsigned long long most_pixels,
                       DrudeOiioTexture* texture) {
    *texture = DrudeOiioTexture{};
    std::string failure;
    try {
        failure = open_texture(path, most_pixels, *texture);
    } catch (const std::exception& error) {
        failure = error.what();
    } catch (...) {
        failure = "unknown failure inside OpenImageIO";
    }
    if (failure.empty()) return 0;
    say(texture->message, sizeof texture->message, failure);
    return 1;
}

int drude_oiio_texels(void* handle, int x0, int x1, int y0, int y1, float* values, char* message,
                      size_t message_size) {
    std::string failure;
    try {
        failure = read_texels(*static_cast<const OpenTexture*>(handle), x0, x1, y0, y1, values);
    } catch (const std::exception& error) {
        failure = error.what();
    } catch (...) {
        failure = "unknown failure inside OpenImageIO";
    }
    if (failure.empty()) return 0;
    say(message, message_size, failure);
    return 1;
}
}
