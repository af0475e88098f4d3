// A scene as the renderer takes it: plain data, no syntax left, every name resolved.
//
// World space is pbrt's (left-handed for an ordinary scene). Matrices act on column vectors.
// Spectra lie on the project's 1 nm grid. What a pbrt-v4 file leaves out has pbrt-v4's default
// here.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/error.h"
#include "image/analyser.h"
#include "materials/spectrum.h"
#include "scene/surfaces.h"
#include "scene/textures.h"

namespace drude {

// ---- shapes ------------------------------------------------------------------------------------

struct Sphere {
    double radius = 1;
    double z_min = -1, z_max = 1;  // object space, clamped to [-radius, radius]
    double phi_max_deg = 360;
};

// A ring at z = height around the z axis, or a sector of it; its normal is +z.
struct Disk {
    double height = 0;
    double radius = 1;
    double inner_radius = 0;  // in [0, radius)
    double phi_max_deg = 360;
};

// The side of a cylinder around the z axis, or a sector of it; its normal points outwards.
struct Cylinder {
    double radius = 1;
    double z_min = -1, z_max = 1;  // z_min < z_max
    double phi_max_deg = 360;
};

struct TriangleMesh {
    std::vector<glm::vec3> positions;   // object space
    std::vector<glm::vec3> normals;     // one a position, or none
    std::vector<glm::vec2> uv;          // one a position, or none
    std::vector<glm::uvec3> triangles;  // indices of positions
};

using ShapeGeometry = std::variant<Sphere, Disk, Cylinder, TriangleMesh>;

struct Shape {
    ShapeGeometry geometry;
    glm::dmat4 world_from_object{1};
    bool reverse_orientation = false;
    int material = -1;    // index of Scene::materials; -1: an invisible "interface"
    int area_light = -1;  // index of Scene::area_lights; -1: emits nothing
    Place place;
};

// ---- lights ------------------------------------------------------------------------------------

// How polarised a light is: its degree of linear polarisation, and the angle of it in the light's
// own frame (conventions: zero is the object's x axis projected perpendicular to the ray; infinite
// lights: normalize(cross(ray direction from the viewer, light-space z))), counter-clockwise seen
// looking towards the source.
struct LightPolarisation {
    double dop = 0;  // in [0, 1]
    double aolp_deg = 0;
    bool none() const { return !(dop > 0); }
};

// The single-scattering polarisation of a clear sky: dop = maximum * sin^2 g / (1 + cos^2 g), g the
// angle from the sun, at right angles to the plane through ray and sun (Rayleigh 1871).
struct RayleighPattern {
    glm::dvec3 sun{0, 0, 1};  // direction of the sun in light space, unit
    double maximum = 1;       // of dop, in [0, 1]
};

// Radiance that a lat-long (width = 2 height) or equal-area octahedral (square) image gives, or a
// constant.
struct InfiniteLight {
    glm::dmat4 world_from_light{1};
    std::string image;  // resolved path; empty: constant
    // The picture itself, where it comes from the program or was read already; `image` names it.
    std::shared_ptr<const Image> picture;
    DenseSpectrum radiance;  // of a constant light, scale included
    double scale = 1;        // of an image
    LightPolarisation polarisation;
    std::optional<RayleighPattern> rayleigh;  // instead of `polarisation`
    Place place;
};

struct DistantLight {
    DenseSpectrum irradiance{};  // normal irradiance, scale included
    glm::dvec3 direction;        // in which its light travels, world space, unit
    // The light's x axis in world space, unit; its y axis where the light travels along x.
    glm::dvec3 x_axis{1, 0, 0};
    LightPolarisation polarisation;
    Place place;
};

// A point, or a spot: a cone of light around `axis` that falls off between two angles as pbrt-v4's
// smooth step of the cosine.
struct PointLight {
    DenseSpectrum intensity{};  // W sr^-1 nm^-1, scale included
    glm::dvec3 position{0};     // world space
    glm::dvec3 axis{0, 0, 1};   // world space, unit; of a spot
    glm::dvec3 x_axis{1, 0, 0};
    // Cosines of the angles where it ends and where it begins to fall; a point light has -1, -1.
    double cos_end = -1, cos_start = -1;
    LightPolarisation polarisation;
    Place place;
};

struct AreaLight {
    DenseSpectrum radiance;  // scale included
    bool two_sided = false;
    LightPolarisation polarisation;
    Place place;
};

// ---- camera, film, sampling --------------------------------------------------------------------

enum class CameraKind { perspective, orthographic, spherical };
struct Camera {
    CameraKind kind = CameraKind::perspective;
    glm::dmat4 world_from_camera{1};  // camera looks along +z, x right, y up
    double fov_deg = 90;              // of the shorter side of the picture
    // screen window as pbrt has it: x0, x1, y0, y1 on the plane z = 1 / tan(fov/2)
    // (orthographic: in the camera's own units; spherical: 0 to 1 over the whole picture, y up).
    // Where the film is cropped, it is the window of the part that is rendered.
    double screen_window[4] = {-1, 1, -1, 1};
    double lens_radius = 0, focal_distance = 1e6;  // a thin lens; radius 0 is a pinhole
    bool equal_area = true;                        // spherical: else equirectangular
    std::optional<Analyser> analyser;              // a polarising filter before every pixel
};

struct Film {
    int width = 1280, height = 720;  // of what is rendered
    // Of a larger picture only a part may be rendered: see scene/crop.h.
    struct Crop {
        int whole_width = 0, whole_height = 0;
        int x0 = 0, y0 = 0;  // of the part's upper left pixel in the whole picture
    };
    std::optional<Crop> crop;
    std::string filename;           // as the scene names it; empty where it does not
    bool spectral = false;          // Film "spectral": wants the spectral layers
    bool gbuffer = false;           // Film "gbuffer": wants geometry layers
    bool gbuffer_in_world = false;  // its positions and normals: else in camera space
};

enum class FilterKind { box, gaussian, triangle, mitchell };
struct Filter {
    FilterKind kind = FilterKind::gaussian;
    double radius_x = 1.5, radius_y = 1.5;
    double sigma = 0.5;               // gaussian
    double b = 1.0 / 3, c = 1.0 / 3;  // mitchell
};

struct Scene {
    std::string file;
    std::string sha256;  // of the scene's text with everything it includes and refers to by content
    Camera camera;
    Film film;
    Filter filter;
    int samples_per_pixel = 16;
    uint64_t seed = 0;
    int max_depth = 5;  // reflections of a path at most
    std::vector<SurfaceMaterial> materials;
    std::vector<Texture<NumberValue>> number_textures;
    std::vector<Texture<SpectrumValue>> spectrum_textures;
    std::vector<Shape> shapes;
    std::vector<AreaLight> area_lights;
    std::vector<InfiniteLight> infinite_lights;
    std::vector<DistantLight> distant_lights;
    std::vector<PointLight> point_lights;
    std::vector<std::string> warnings;  // for people: substitutions, ranges held, names resolved
    // Those of the warnings that say: pbrt-v4 would have drawn something else here.
    std::vector<std::string> stand_ins;
};

// Reads a pbrt-v4 scene file. Errors (user) carry file:line:column and the nearest valid word.
Scene read_scene(const std::string& path);
// The same from text; `file` names it in errors and is what relative paths are relative to.
Scene parse_scene(const std::string& text, const std::string& file);

}  // namespace drude
