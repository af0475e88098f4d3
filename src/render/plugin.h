/* A material of your own in a shared object: the one header it needs. C and C++.
 *
 * `Material "NAME"` in a scene finds NAME.so or libNAME.so in the folders of DRUDE_PLUGIN_PATH
 * (separated by colons). The object exports one function,
 *
 *     const DrudeSurfacePlugin* drude_surface_plugin(void);
 *
 * which returns a table that lives as long as the program. Only floats and counts pass between the
 * two sides, so that a plugin may be built by another compiler, for another instruction set and
 * with other options than the renderer. docs/plugins.md has an example, start to end.
 *
 * A surface reflects: light arrives and leaves on the side from which the path came, whichever
 * that is. Local coordinates have z along the normal on that side; their azimuth is arbitrary, so
 * that surfaces are isotropic.
 */
#ifndef DRUDE_RENDER_PLUGIN_H
#define DRUDE_RENDER_PLUGIN_H

/* C, whatever C++ has for it. NOLINTBEGIN(modernize-use-using,modernize-deprecated-headers) */
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Changes with every change to what is declared below. */
#define DRUDE_PLUGIN_VERSION 1

/* The extensions of x86-64 that the including file is compiled for, one word each with a blank
 * before it; "" for the x86-64 of 2003. */
#ifdef __SSE4_2__
#define DRUDE_HAS_SSE42 " sse4.2"
#else
#define DRUDE_HAS_SSE42 ""
#endif
#ifdef __AVX__
#define DRUDE_HAS_AVX " avx"
#else
#define DRUDE_HAS_AVX ""
#endif
#ifdef __AVX2__
#define DRUDE_HAS_AVX2 " avx2"
#else
#define DRUDE_HAS_AVX2 ""
#endif
#ifdef __FMA__
#define DRUDE_HAS_FMA " fma"
#else
#define DRUDE_HAS_FMA ""
#endif
#ifdef __BMI2__
#define DRUDE_HAS_BMI2 " bmi2"
#else
#define DRUDE_HAS_BMI2 ""
#endif
#ifdef __FMA4__
#define DRUDE_HAS_FMA4 " fma4"
#else
#define DRUDE_HAS_FMA4 ""
#endif
#ifdef __XOP__
#define DRUDE_HAS_XOP " xop"
#else
#define DRUDE_HAS_XOP ""
#endif
#ifdef __AVX512F__
#define DRUDE_HAS_AVX512F " avx512f"
#else
#define DRUDE_HAS_AVX512F ""
#endif
#ifdef __AVX512BW__
#define DRUDE_HAS_AVX512BW " avx512bw"
#else
#define DRUDE_HAS_AVX512BW ""
#endif
#ifdef __AVX512DQ__
#define DRUDE_HAS_AVX512DQ " avx512dq"
#else
#define DRUDE_HAS_AVX512DQ ""
#endif
#ifdef __AVX512VL__
#define DRUDE_HAS_AVX512VL " avx512vl"
#else
#define DRUDE_HAS_AVX512VL ""
#endif
#ifdef __AVX512VBMI__
#define DRUDE_HAS_AVX512VBMI " avx512vbmi"
#else
#define DRUDE_HAS_AVX512VBMI ""
#endif
#ifdef __AVX512VNNI__
#define DRUDE_HAS_AVX512VNNI " avx512vnni"
#else
#define DRUDE_HAS_AVX512VNNI ""
#endif
#define DRUDE_INSTRUCTION_SET                                                                    \
    DRUDE_HAS_SSE42 DRUDE_HAS_AVX DRUDE_HAS_AVX2 DRUDE_HAS_FMA DRUDE_HAS_BMI2 DRUDE_HAS_FMA4     \
        DRUDE_HAS_XOP DRUDE_HAS_AVX512F DRUDE_HAS_AVX512BW DRUDE_HAS_AVX512DQ DRUDE_HAS_AVX512VL \
            DRUDE_HAS_AVX512VBMI DRUDE_HAS_AVX512VNNI

/* A parameter that the scene gives. The renderer has checked name, type and number of values. */
typedef struct DrudeParameter {
    const char* name;
    /* Values: of "float" and "integer" the numbers, of "bool" 0 or 1, of "rgb" three each, of
     * "spectrum" one a nanometre from 380 to 780; of "string" and "file" none. */
    const double* numbers;
    /* Of "string" the text, of "file" the path of a file that exists. */
    const char* const* strings;
    /* Entries of the array that the type uses; the other array is null. */
    int32_t count;
    int32_t reserved;
} DrudeParameter;

/* A pair of directions and the frames of the polarised light along them. Local coordinates; every
 * vector has length 1 within rounding.
 *
 * A ray of direction k has a frame (x, y) with y = handedness * cross(k, x): k = -in for the light
 * that arrives, k = out for that which leaves. S1 > 0 along x, S2 > 0 at 45 degrees from x towards
 * y, S3 > 0 clockwise seen looking towards the source. Any x_out and x_in may come. */
typedef struct DrudeDirections {
    float out[3];     /* away from the surface, to where the light leaves; z > 0 */
    float in[3];      /* away from the surface, to where it comes from; z > 0 */
    float x_out[3];   /* across out */
    float x_in[3];    /* across in */
    float handedness; /* 1 or -1 */
} DrudeDirections;

/* Functions may be called from many threads at once, on one instance, and must neither change it
 * nor throw: the picture is a function of the seed because a plugin is a function of its
 * arguments. */
typedef struct DrudeSurfacePlugin {
    uint32_t version; /* DRUDE_PLUGIN_VERSION */
    uint32_t size;    /* sizeof(DrudeSurfacePlugin) */
    /* DRUDE_INSTRUCTION_SET. What the processor lacks is refused before any function below is
     * called; static constructors have run by then, so have none that need more than x86-64. */
    const char* instruction_set;
    const char* description; /* one line for people */
    /* "TYPE NAME" each, and a null at the end: TYPE is float, integer, bool, rgb, spectrum, string
     * or file. "TYPE NAME[]" takes any number of values (not of spectrum), otherwise it is one.
     * "file" is written "string" in the scene, found beside the scene, and counted into its hash.
     */
    const char* const* parameters;

    /* A surface from what the scene gives; what it leaves out is not in the list. On failure null,
     * with the reason as text for people in message, which has room for message_size bytes. */
    void* (*create)(const DrudeParameter* parameters, int32_t count, char* message,
                    int32_t message_size);
    void (*destroy)(void* surface);

    /* Mueller matrices of the BRDF (per steradian) times the cosine of `in`, at `count` vacuum
     * wavelengths: mueller[16 * w + 4 * row + column]. They take Stokes vectors in the frame of
     * the light that arrives to those in the frame of the light that leaves. Each has to be finite
     * and physical (|M_ij| <= M_00, at the least). No lobe is so narrow that it has no density:
     * perfect mirrors cannot be plugins. */
    void (*evaluate)(const void* surface, const DrudeDirections* directions,
                     const float* wavelengths_nm, int32_t count, float* mueller);
    /* A direction `in` for `out`, drawn with three uniform numbers in [0, 1), and its density per
     * steradian. 0 where there is none: the light is absorbed. Wherever `evaluate` gives more than
     * zero the density should not be zero. */
    int32_t (*sample)(const void* surface, const float out[3], const float u[3], float in[3],
                      float* pdf);
    /* The density with which `sample` chooses `in`. */
    float (*pdf)(const void* surface, const float out[3], const float in[3]);
} DrudeSurfacePlugin;

#if defined(__GNUC__)
#define DRUDE_PLUGIN_EXPORT __attribute__((visibility("default")))
#else
#define DRUDE_PLUGIN_EXPORT
#endif

/* What a plugin defines. */
DRUDE_PLUGIN_EXPORT const DrudeSurfacePlugin* drude_surface_plugin(void);

#ifdef __cplusplus
}
#endif

/* NOLINTEND(modernize-use-using,modernize-deprecated-headers) */
#endif
