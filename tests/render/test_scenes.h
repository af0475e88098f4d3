// Scenes whose pictures are known on paper.
#pragma once

#include <fmt/format.h>

#include <string>

#include "render/render.h"
#include "scene/scene.h"

namespace drude {

// A unit sphere of the given material line at the origin under a constant white sky, seen from
// (0, 0, -4) along +z, x right and y up; `before` stands before LookAt ("Scale -1 1 1").
inline Scene sphere_under_sky(const std::string& material, int size, const std::string& before = "",
                              const std::string& shape = "") {
    return parse_scene(
        fmt::format("{}\nLookAt 0 0 -4  0 0 0  0 1 0\n"
                    "Camera \"perspective\" \"float fov\" 32\n"
                    "Film \"rgb\" \"integer xresolution\" {} \"integer yresolution\" {}\n"
                    "PixelFilter \"box\"\nIntegrator \"path\" \"integer maxdepth\" 8\n"
                    "WorldBegin\nLightSource \"infinite\" \"rgb L\" [1 1 1]\n"
                    "{}\nShape \"sphere\" {}\n",
                    before, size, size, material, shape),
        "sphere.pbrt");
}

inline RenderResult render_quietly(const Scene& scene, int samples, bool stokes = false,
                                   bool spectral = false, int threads = 0) {
    RenderOptions options;
    options.samples_per_pixel = samples;
    options.stokes = stokes;
    options.spectral = spectral;
    options.threads = threads;
    options.quiet = true;
    return render(scene, options);
}

}  // namespace drude
