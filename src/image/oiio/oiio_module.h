// What drude-oiio.so offers: plain C types only, so that neither side depends on the other's
// headers, and no exception crosses the border.
#pragma once

#include <cstddef>

extern "C" {

// Raised whenever a signature below changes; the loader refuses another number.
inline constexpr int drude_oiio_interface = 1;

struct DrudeOiioPicture {
    int width, height, channels;
    int is_integer;     // the file's samples are integers, scaled here to [0, 1]
    float* values;      // width*height*channels, interleaved; released by drude_oiio_release
    char message[512];  // why it failed
};

using DrudeOiioSink = void (*)(void* context, const void* bytes, size_t count);

int drude_oiio_version();
// 0, or 1 with a message. At most `most_pixels` pixels.
int drude_oiio_read(const char* path, unsigned long long most_pixels, DrudeOiioPicture* picture);
void drude_oiio_release(DrudeOiioPicture* picture);
// An 8-bit RGB PNG handed to `sink`. 0, or 1 with a message.
int drude_oiio_png(int width, int height, const unsigned char* rgb, DrudeOiioSink sink,
                   void* context, char* message, size_t message_size);
}
