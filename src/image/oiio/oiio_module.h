// What drude-oiio.so offers: plain C types only, so that neither side depends on the other's
// headers, and no exception crosses the border.
#pragma once

#include <cstddef>

extern "C" {

// Raised whenever a signature below changes; the loader refuses another number.
inline constexpr int drude_oiio_interface = 2;

struct DrudeOiioPicture {
    int width, height, channels;
    int is_integer;     // the file's samples are integers, scaled here to [0, 1]
    float* values;      // width*height*channels, interleaved; released by drude_oiio_release
    char message[512];  // why it failed
};

// A picture whose pixels come through OpenImageIO's cache, which holds a bounded part of all of
// them in memory.
struct DrudeOiioTexture {
    int width, height;
    int channels;    // 1, or the 3 of R, G, B; others of the file are left out
    int is_integer;  // the file's samples are integers, scaled here to [0, 1]
    void* handle;    // for drude_oiio_texels(), as long as the process lives
    char message[512];
};

using DrudeOiioSink = void (*)(void* context, const void* bytes, size_t count);

int drude_oiio_version();
// 0, or 1 with a message. At most `most_pixels` pixels.
int drude_oiio_read(const char* path, unsigned long long most_pixels, DrudeOiioPicture* picture);
void drude_oiio_release(DrudeOiioPicture* picture);
// 0, or 1 with a message. At most `most_pixels` pixels.
int drude_oiio_texture(const char* path, unsigned long long most_pixels, DrudeOiioTexture* texture);
// The pixels [x0, x1) x [y0, y1) of it, all of them within the picture, rows from the top, as
// `channels` interleaved values each. From any thread. 0, or 1 with a message.
int drude_oiio_texels(void* handle, int x0, int x1, int y0, int y1, float* values, char* message,
                      size_t message_size);
// An 8-bit RGB PNG handed to `sink`. 0, or 1 with a message.
int drude_oiio_png(int width, int height, const unsigned char* rgb, DrudeOiioSink sink,
                   void* context, char* message, size_t message_size);
}
