// What a picture's pixels see, beside its light: Film "gbuffer".
#pragma once

#include "image/image.h"
#include "render/camera_ray.h"
#include "render/geometry.h"

namespace drude {

// Adds to `image`, which has the film's size, of the first surface behind each pixel's centre
// (through the middle of a lens; straight through polarisers and retarders):
//   P.X P.Y P.Z     position, in camera space or, where the film wants it, in the world;
//   Z               depth: camera z, or the distance in a spherical picture, in camera space;
//   N.X N.Y N.Z     geometric normal, unit, on the side of the camera, in the space of P;
//   Ns.X Ns.Y Ns.Z  shading normal, likewise;
//   u v             pbrt-v4's surface parameters;
//   Albedo.R .G .B  see albedo.h;
//   Material        index of Scene::materials.
// Where nothing is seen all are 0, and Material is -1. They are not averaged over a pixel: a mean
// of two positions is the place of nothing. The attribute "geometrySpace" is "camera" or "world".
// The order of threads changes no bit. Throws Error (user) for a texture that cannot be read.
void add_geometry_layers(const Scene& scene, const Geometry& geometry, const CameraRays& camera,
                         int threads, Image* image);

}  // namespace drude
