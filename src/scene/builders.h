// From a directive's parameters to a piece of the scene, one function a concept.
//
// Every function reads what it understands of `list`, gives what pbrt-v4 knows beyond that a
// message, and throws Error (user) with its place for anything else. Adding a shape, a material, a
// light, a camera or a filter means a function in its own file and its line in the switch of its
// kind.
#pragma once

#include <functional>
#include <glm/mat4x4.hpp>
#include <map>
#include <optional>
#include <string>
#include <variant>

#include "scene/assets.h"
#include "scene/messages.h"
#include "scene/parameters.h"
#include "scene/scene.h"

namespace drude {

// Named textures, and those of them that change over a surface. A texture that is the same
// everywhere is a constant from the start.
struct Textures {
    std::map<std::string, NumberValue, std::less<>> numbers;
    std::map<std::string, SpectrumValue, std::less<>> spectra;
    std::vector<Texture<NumberValue>> number_textures;
    std::vector<Texture<SpectrumValue>> spectrum_textures;
    // How many textures one evaluation visits at most.
    std::vector<int> number_visits, spectrum_visits;
};

struct BuildContext {
    Assets& assets;
    Messages& messages;
    Textures& textures;
    // What stands for the material of that name until names are resolved, at the scene's end.
    std::function<int(const std::string& name, const Place& place)> material_named;
};

// ---- settings ----------------------------------------------------------------------------------

// The film as a whole, and the pixels of it that are rendered: x0 <= x < x1, y0 <= y < y1.
struct FilmRecipe {
    Film film;
    int bounds[4];  // x0 x1 y0 y1
};
FilmRecipe build_film(const std::string& name, ParameterList& list, Messages& messages);
// `camera_from_world` is the current transformation at the Camera directive, `film` the whole one.
Camera build_camera(const std::string& name, ParameterList& list,
                    const glm::dmat4& camera_from_world, const Film& film, Messages& messages);
Filter build_filter(const std::string& name, ParameterList& list, Messages& messages);
void build_sampler(const std::string& name, ParameterList& list, Messages& messages, Scene& scene);
void build_integrator(const std::string& name, ParameterList& list, Messages& messages,
                      Scene& scene);

// ---- shapes ------------------------------------------------------------------------------------

// Nothing where the shape is one that pbrt-v4 knows and this renderer leaves out.
std::optional<ShapeGeometry> build_shape(const std::string& name, ParameterList& list,
                                         BuildContext& context);
Sphere build_sphere(ParameterList& list);
Disk build_disk(ParameterList& list);
Cylinder build_cylinder(ParameterList& list);
TriangleMesh build_triangle_mesh(ParameterList& list, Messages& messages);
TriangleMesh build_bilinear_mesh(ParameterList& list, Messages& messages);
TriangleMesh build_loop_surface(ParameterList& list, Messages& messages);
TriangleMesh build_ply_mesh(ParameterList& list, BuildContext& context);
// Drops triangles without area and gives normals of length 0 a direction; Error (user) where no
// triangle is left.
void tidy_mesh(TriangleMesh& mesh, const std::string& owner, const Place& place,
               Messages& messages);
// In world space.
double surface_area(const ShapeGeometry& geometry, const glm::dmat4& world_from_object);

// ---- materials, textures -----------------------------------------------------------------------

// Nothing for "interface" (and ""): a surface that is not there.
std::optional<SurfaceMaterial> build_material(const std::string& name, ParameterList& list,
                                              BuildContext& context);
// `prefix` is "conductor." for the metal under a coat, otherwise "".
ConductorMaterial build_conductor(ParameterList& list, const std::string& prefix,
                                  BuildContext& context);
DielectricMaterial build_dielectric(ParameterList& list, BuildContext& context);
ThinDielectricMaterial build_thin_dielectric(ParameterList& list, BuildContext& context);
// "coatedconductor", or else "coateddiffuse".
CoatedMaterial build_coated(ParameterList& list, bool on_metal, BuildContext& context);
DiffuseTransmissionMaterial build_diffuse_transmission(ParameterList& list, BuildContext& context);
// `name` is "linearpolariser", "retarder" or "circularpolariser".
OpticalElementMaterial build_optical_element(const std::string& name, ParameterList& list);
// `is_spectrum` tells the two kinds, "spectrum" and "float", apart. Enters the texture under
// `name`.
void build_texture(const std::string& name, bool is_spectrum, const std::string& type,
                   ParameterList& list, const glm::dmat4& world_from_texture,
                   BuildContext& context);
// Texture "imagemap".
ImageTexture build_image_texture(ParameterList& list, const glm::dmat4& world_from_texture,
                                 BuildContext& context);
// "mapping" and what belongs to it.
TextureMapping build_mapping(ParameterList& list, const glm::dmat4& world_from_texture);

// ---- lights ------------------------------------------------------------------------------------

// Appends to the scene's lights.
void build_light(const std::string& name, ParameterList& list, const glm::dmat4& world_from_light,
                 BuildContext& context, Scene& scene);

// How polarised a light is, uniformly; and an infinite light, in a pattern or uniformly.
LightPolarisation read_light_polarisation(ParameterList& list);
void read_sky_polarisation(ParameterList& list, InfiniteLight* light);

// What an AreaLightSource says before it meets its shape.
struct AreaLightRecipe {
    AreaLight light;
    double power = 0;  // > 0: the radiance follows from the shape's area
};
AreaLightRecipe build_area_light(const std::string& name, ParameterList& list,
                                 BuildContext& context);
// The light of a shape of this area (world space).
AreaLight area_light_on(const AreaLightRecipe& recipe, double area);

}  // namespace drude
