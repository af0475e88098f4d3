#include "cli/scene_description.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <variant>
#include <vector>

namespace drude {

namespace {

// "2 conductors, 1 diffuse", kinds that do not occur left out.
template <class Variant>
std::string counted(const std::vector<Variant>& list,
                    const std::array<std::string_view, std::variant_size_v<Variant>>& names) {
    std::array<size_t, std::variant_size_v<Variant>> count{};
    for (const Variant& member : list) ++count[member.index()];
    std::vector<std::string> parts;
    for (size_t i = 0; i < count.size(); ++i) {
        if (count[i] > 0) parts.push_back(fmt::format("{} {}", count[i], names[i]));
    }
    return parts.empty() ? "none" : fmt::format("{}", fmt::join(parts, ", "));
}

std::string shapes_of(const Scene& scene) {
    size_t triangles = 0, meshes = 0, spheres = 0, disks = 0, cylinders = 0, invisible = 0;
    for (const Shape& shape : scene.shapes) {
        invisible += shape.material < 0;
        if (const auto* mesh = std::get_if<TriangleMesh>(&shape.geometry)) {
            ++meshes;
            triangles += mesh->triangles.size();
        } else if (std::holds_alternative<Sphere>(shape.geometry)) {
            ++spheres;
        } else if (std::holds_alternative<Disk>(shape.geometry)) {
            ++disks;
        } else {
            ++cylinders;
        }
    }
    std::string text = fmt::format("{} spheres, {} disks, {} cylinders, {} meshes of {} triangles",
                                   spheres, disks, cylinders, meshes, triangles);
    if (invisible > 0) text += fmt::format("; {} of them invisible interfaces", invisible);
    return text;
}

std::string_view camera_name(CameraKind kind) {
    switch (kind) {
        case CameraKind::perspective:
            return "perspective";
        case CameraKind::orthographic:
            return "orthographic";
        case CameraKind::spherical:
            break;
    }
    return "spherical";
}

}  // namespace

std::string describe_scene(const Scene& scene) {
    std::string text = fmt::format(
        "{}: {} x {} pixels, {} camera{}{}, {} samples, at most {} reflections a path\n",
        scene.file, scene.film.width, scene.film.height, camera_name(scene.camera.kind),
        scene.camera.lens_radius > 0 ? " with a lens" : "",
        scene.camera.analyser
            ? fmt::format(" behind an analyser ({})", format_analyser(*scene.camera.analyser))
            : "",
        scene.samples_per_pixel, scene.max_depth);
    text += fmt::format("  shapes: {}\n", shapes_of(scene));
    text += fmt::format(
        "  materials: {}\n",
        counted(scene.materials, {"conductor", "diffuse", "diffusetransmission", "dielectric",
                                  "thindielectric", "coated", "mix", "optical element", "plugin"}));
    const auto spots = std::count_if(scene.point_lights.begin(), scene.point_lights.end(),
                                     [](const PointLight& light) { return light.cos_end > -1; });
    text += fmt::format("  lights: {} infinite, {} distant, {} point, {} spot, {} area\n",
                        scene.infinite_lights.size(), scene.distant_lights.size(),
                        scene.point_lights.size() - static_cast<size_t>(spots), spots,
                        scene.area_lights.size());
    if (!scene.number_textures.empty() || !scene.spectrum_textures.empty()) {
        text += fmt::format("  textures: {} of numbers, {} of spectra\n",
                            scene.number_textures.size(), scene.spectrum_textures.size());
    }
    text += fmt::format("  hash {}\n", scene.sha256);
    return text;
}

}  // namespace drude
