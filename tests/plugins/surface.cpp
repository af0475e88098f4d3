// The plugins of the tests. One source: definitions of the build (tests/CMakeLists.txt) make it a
// good one or one of many bad ones.
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

#include "plugin_frames.h"

#ifndef PLUGIN_VERSION
#define PLUGIN_VERSION DRUDE_PLUGIN_VERSION
#endif
#ifndef PLUGIN_SIZE
#define PLUGIN_SIZE sizeof(DrudeSurfacePlugin)
#endif
#ifndef PLUGIN_ISA
#define PLUGIN_ISA DRUDE_INSTRUCTION_SET
#endif
#ifndef PLUGIN_PARAMETERS
#define PLUGIN_PARAMETERS                                                                   \
    "float reflectance", "float n", "float k", "float alpha", "integer count", "bool flag", \
        "rgb tint", "spectrum colour", "string label", "file table", "float list[]", "rgb rgbs[]"
#endif

namespace {

using drude_plugin::dot;
using drude_plugin::Vector;
using drude_plugin::vector;

constexpr float pi = 3.14159265358979f;

struct Surface {
    float reflectance = 1, n = 1, k = 0, alpha = 0.3f;
};

// A perfect depolariser.
[[maybe_unused]] void lambert(const Surface& surface, const DrudeDirections& d, float m[16]) {
    m[0] = surface.reflectance * d.in[2] / pi;
}

// Rough metal: Trowbridge-Reitz facets, height-correlated Smith masking (Heitz 2014, JCGT 3(2)),
// and Fresnel's amplitudes in complex numbers.
[[maybe_unused]] void metal(const Surface& surface, const DrudeDirections& d, float m[16]) {
    const drude_plugin::HalfVectorFrames frames(d);
    const float cos_i = d.in[2], cos_o = d.out[2], a2 = surface.alpha * surface.alpha;
    const float cos_h = frames.half().z;
    const float q = cos_h * cos_h * (a2 - 1) + 1;
    const float facets = a2 / (pi * q * q);
    const float masking = 0.5f / (cos_i * std::sqrt(a2 + (1 - a2) * cos_o * cos_o) +
                                  cos_o * std::sqrt(a2 + (1 - a2) * cos_i * cos_i));
    const float value = facets * masking * cos_i;
    using Complex = std::complex<double>;
    const Complex index(static_cast<double>(surface.n), static_cast<double>(surface.k));
    const double c = std::min(1.0, static_cast<double>(dot(vector(d.in), frames.half())));
    const Complex ct = std::sqrt(1.0 - (1 - c * c) / (index * index));
    const Complex rs = (c - index * ct) / (c + index * ct),
                  rp = (index * c - ct) / (index * c + ct);
    // r_p / r_s with exp(-i w t) is tan(Psi) exp(-i Delta).
    const Complex cross_term = rp * std::conj(rs);
    const float Rs = static_cast<float>(std::norm(rs)), Rp = static_cast<float>(std::norm(rp));
    m[0] = m[5] = value * (Rs + Rp) / 2;
    m[1] = m[4] = value * (Rs - Rp) / 2;
    m[10] = m[15] = value * static_cast<float>(cross_term.real());
    m[14] = value * static_cast<float>(-cross_term.imag());
    m[11] = -m[14];
    frames.to_ray_frames(m);
}

#ifdef PLUGIN_FAILS
// Fails with all it was given, so that tests can read it.
void* create(const DrudeParameter* parameters, int32_t count, char* message, int32_t size) {
    std::string text = "given:";
    for (int32_t p = 0; p < count; ++p) {
        const DrudeParameter& parameter = parameters[p];
        text += " " + std::string(parameter.name) + "=";
        if (parameter.count > 10) text += std::to_string(parameter.count) + "*";
        for (int32_t i = 0; i < std::min(parameter.count, 10); ++i) {
            char number[40] = "";
            if (parameter.numbers)
                std::snprintf(number, sizeof number, "%g,", parameter.numbers[i]);
            text +=
                parameter.numbers ? std::string(number) : parameter.strings[i] + std::string(",");
        }
    }
    std::snprintf(message, static_cast<size_t>(size), "%s", text.c_str());
    return nullptr;
}
#elif defined(PLUGIN_SILENT)
void* create(const DrudeParameter*, int32_t, char*, int32_t) {
    return nullptr;
}
#elif defined(PLUGIN_THROWS)
void* create(const DrudeParameter*, int32_t, char*, int32_t) {
    throw std::runtime_error("thrown by the plugin");
}
#elif defined(PLUGIN_LONG_MESSAGE)
void* create(const DrudeParameter*, int32_t, char* message, int32_t size) {
    std::memset(message, 'x', static_cast<size_t>(size));
    return nullptr;
}
#else
void* create(const DrudeParameter* parameters, int32_t count, char*, int32_t) {
    auto* surface = new Surface;
    for (int32_t p = 0; p < count; ++p) {
        const std::string name = parameters[p].name;
        if (!parameters[p].numbers) continue;
        const float value = static_cast<float>(parameters[p].numbers[0]);
        if (name == "reflectance") surface->reflectance = value;
        if (name == "n") surface->n = value;
        if (name == "k") surface->k = value;
        if (name == "alpha") surface->alpha = value;
    }
    return surface;
}
#endif

void destroy(void* surface) {
    delete static_cast<Surface*>(surface);
}

[[maybe_unused]] void evaluate(const void* surface, const DrudeDirections* d, const float*,
                               int32_t count, float* mueller) {
    for (int32_t w = 0; w < count; ++w) {
        float m[16] = {};
#ifdef PLUGIN_METAL
        metal(*static_cast<const Surface*>(surface), *d, m);
#else
        lambert(*static_cast<const Surface*>(surface), *d, m);
#endif
#ifdef PLUGIN_NOT_FINITE
        m[6] = std::numeric_limits<float>::quiet_NaN();
#endif
#ifdef PLUGIN_UNPHYSICAL
        m[1] = 3 * m[0];
#endif
        std::copy(m, m + 16, mueller + 16 * w);
    }
}

[[maybe_unused]] float pdf(const void*, const float*, const float in[3]) {
    return in[2] / pi;
}

[[maybe_unused]] int32_t sample(const void*, const float*, const float u[3], float in[3],
                                float* density) {
    const float r = std::sqrt(u[0]), phi = 2 * pi * u[1];
    in[0] = r * std::cos(phi);
    in[1] = r * std::sin(phi);
    in[2] = std::sqrt(std::max(0.0f, 1 - u[0]));
#ifdef PLUGIN_LONG_DIRECTION
    in[0] += 10;
#endif
    *density = in[2] / pi;
    return 1;
}

const char* const parameters[] = {PLUGIN_PARAMETERS, nullptr};

#ifdef PLUGIN_NO_EVALUATE
constexpr decltype(DrudeSurfacePlugin::evaluate) evaluate_of_table = nullptr;
#else
constexpr decltype(DrudeSurfacePlugin::evaluate) evaluate_of_table = evaluate;
#endif

[[maybe_unused]] const DrudeSurfacePlugin plugin = {
    PLUGIN_VERSION, PLUGIN_SIZE, PLUGIN_ISA,        "for tests", parameters,
    create,         destroy,     evaluate_of_table, sample,      pdf};

}  // namespace

#ifndef PLUGIN_NO_SYMBOL
const DrudeSurfacePlugin* drude_surface_plugin(void) {
#ifdef PLUGIN_NO_TABLE
    return nullptr;
#else
    return &plugin;
#endif
}
#endif
