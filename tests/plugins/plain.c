/* The header is C: a plugin without any C++ in it, which reflects nothing. */
#include "plugin.h"

static int surface;

static void* create(const DrudeParameter* parameters, int32_t count, char* message,
                    int32_t message_size) {
    (void)parameters, (void)count, (void)message, (void)message_size;
    return &surface;
}
static void destroy(void* self) {
    (void)self;
}
static void evaluate(const void* self, const DrudeDirections* directions,
                     const float* wavelengths_nm, int32_t count, float* mueller) {
    (void)self, (void)directions, (void)wavelengths_nm;
    for (int32_t i = 0; i < 16 * count; ++i) mueller[i] = 0;
}
static int32_t sample(const void* self, const float out[3], const float u[3], float in[3],
                      float* density) {
    (void)self, (void)out, (void)u, (void)in, (void)density;
    return 0;
}
static float pdf(const void* self, const float out[3], const float in[3]) {
    (void)self, (void)out, (void)in;
    return 0;
}

static const char* const parameters[] = {0};
static const DrudeSurfacePlugin plugin = {
    DRUDE_PLUGIN_VERSION, sizeof(DrudeSurfacePlugin), DRUDE_INSTRUCTION_SET, "black", parameters,
    create,               destroy,                    evaluate,              sample,  pdf};

const DrudeSurfacePlugin* drude_surface_plugin(void) {
    return &plugin;
}
