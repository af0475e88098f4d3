// The reference integrator: what the renderer's fast paths are checked against. Slow, and written
// so that a reader can see that it is right.
//
// Double precision throughout; every path carries dense 4x4 Mueller matrices; light is found only
// by walking into it. No light sampling, no multiple importance sampling, no roulette, no Embree
// (every ray is tried against every primitive), no packets, no low-discrepancy samples. What it
// shares with the renderer is the scene's data and the optics of materials/, which have tests of
// their own.
//
// It covers
//   shapes     spheres (cut or whole) and triangle meshes with vertex normals, under any affine
//              transformation, mirroring ones and reversed orientation included;
//   materials  conductors (bare, under films averaged over each nanometre, or of a fixed
//              reflectance), dielectrics, smooth or rough, and thin ones, coats, as a walk between
//              their two surfaces, diffusers, mixtures, and optical elements, straight through
//              which light is found; textures count with their typical value. Where an index
//              changes with wavelength, a path has one wavelength. Plugins are asked for one
//              wavelength at a time. Coats are refused in scenes with lights that have no size;
//   lights     area lights (one- or two-sided), infinite lights (constant, lat-long, equal-area),
//              distant and point lights and spots. The last three have no size to walk into:
//              wherever a path meets a surface that is not smooth, their term
//              M(o <- i) E(lambda) cos_i * visibility is added in closed form. What is smooth never
//              shows one. All of them may be polarised;
//   cameras    all, with a lens;
//   the film   box filters. Others are refused.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace drude {

struct ReferenceOptions {
    // How directions are chosen: by the material's own sampling, or uniformly over the hemisphere,
    // which knows nothing of lobes (mirrors have one direction only).
    enum class Directions { lobe, hemisphere };

    // Each band is a list of vacuum wavelengths in nm, each in [380, 780]; its result is the mean
    // over them (every path draws one of each band). A band of one is a single wavelength.
    std::vector<std::vector<double>> bands_nm;
    int samples_per_pixel = 64;  // at least 2
    uint64_t seed = 0;
    Directions directions = Directions::lobe;
    int threads = 0;
};

struct ReferenceResult {
    int width = 0, height = 0, bands = 0;
    uint64_t rays = 0;

    // S0..S3 in W m^-2 sr^-1 nm^-1 in the picture's frame, and their standard errors.
    struct Value {
        std::array<double, 4> mean{}, standard_error{};
    };
    std::vector<Value> values;  // [y][x][band]
    const Value& at(int x, int y, int band) const {
        return values[(static_cast<size_t>(y) * width + x) * bands + band];
    }
};

// Reads the pictures of infinite lights. The same options give the same numbers on any number of
// threads. Throws Error (user) for a filter that is not a box, no band or an empty one, a
// wavelength out of range, fewer than two samples, or a picture that cannot be read.
ReferenceResult render_reference(const Scene& scene, const ReferenceOptions& options);

}  // namespace drude
