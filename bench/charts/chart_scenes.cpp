#include "bench/charts/chart_scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "materials/embedded_tables.h"
#include "materials/scalar.h"
#include "render/courtyard.h"
#include "scene/resolution.h"

namespace drude {

namespace {

// The folder that the scenes' geometry lies in; "scenes" where there is none.
std::string scenes_folder() {
    namespace fs = std::filesystem;
    std::error_code ignored;
    const fs::path program = fs::read_symlink("/proc/self/exe", ignored).parent_path();
    for (const fs::path& folder :
         {fs::path("scenes"), program / "scenes", program.parent_path() / "scenes",
          program.parent_path() / "share" / "drude" / "scenes"}) {
        if (fs::exists(folder / "geometry" / "teapot.ply", ignored)) return folder.string();
    }
    return "scenes";
}

}  // namespace

Scene chart_scene(const std::string& name, int width, int height, const std::string& of,
                  const std::string& instead) {
    const auto& scenes = embedded_scenes();
    const auto found = std::find_if(scenes.begin(), scenes.end(),
                                    [&](const EmbeddedTable& s) { return s.name == name; });
    if (found == scenes.end()) throw std::logic_error("chart_scene: no scene " + name);
    std::string text(found->text);
    if (!of.empty()) {
        const size_t at = text.find(of);
        if (at == std::string::npos || text.find(of, at + 1) != std::string::npos) {
            throw std::logic_error("chart_scene: not once in " + name + ": " + of);
        }
        text.replace(at, of.size(), instead);
    }
    Scene scene = parse_scene(text, scenes_folder() + "/" + name + ".pbrt");
    set_resolution(fmt::format("{}x{}", width, height), "size", &scene);
    scene.warnings.clear();  // of the program's own text
    return scene;
}

Scene teapot_on_plaster(int width, int height) {
    return chart_scene("gold-teapot", width, height);
}

Scene teapot_on_metal(int width, int height) {
    return chart_scene("gold-teapot", width, height,
                       "Material \"diffuse\" \"rgb reflectance\" [ 0.35 0.34 0.33 ]",
                       "Material \"conductor\" \"string material\" \"Al\" \"string lobe\" "
                       "\"beckmann\" \"float beta\" 0.1");
}

namespace {

void light_by_courtyard(Scene* scene) {
    static const auto courtyard = std::make_shared<const Image>(make_courtyard(128));
    InfiniteLight light;
    light.world_from_light = scene->infinite_lights.front().world_from_light;
    light.image = "courtyard";
    light.picture = courtyard;
    scene->infinite_lights = {light};
}

}  // namespace

Scene half_sphere_in_courtyard(int width, int height, const std::string& material) {
    Scene scene = chart_scene("half-sphere", width, height,
                              "Material \"conductor\" \"string material\" \"Cu\"\n"
                              "    \"string lobe\" \"blinn-phong\" \"string masking\" "
                              "\"v-groove\" \"float beta\" 0.011774",
                              material);
    light_by_courtyard(&scene);
    return scene;
}

Scene sphere_in_courtyard(int width, int height, const std::string& material) {
    Scene scene = parse_scene(
        fmt::format("LookAt 0 -4 0.5  0 0 0  0 0 1\nCamera \"perspective\" \"float fov\" 36\n"
                    "Film \"rgb\" \"integer xresolution\" {} \"integer yresolution\" {}\n"
                    "PixelFilter \"box\"\nIntegrator \"path\" \"integer maxdepth\" 12\n"
                    "WorldBegin\nLightSource \"infinite\"\n{}\nShape \"sphere\"\n",
                    width, height, material),
        "sphere.pbrt");
    light_by_courtyard(&scene);
    return scene;
}

Scene metals_in_light(int width, int height, const DenseSpectrum& light) {
    const auto metal = [](const char* name, double beta) {
        return fmt::format(
            "Material \"conductor\" \"string material\" \"{}\" \"string lobe\" "
            "\"trowbridge-reitz\" \"float beta\" {}\n",
            name, beta);
    };
    Scene scene = parse_scene(
        fmt::format("LookAt 0 -6 3.2  0 0 0.45  0 0 1\nCamera \"perspective\" \"float fov\" 34\n"
                    "Film \"rgb\" \"integer xresolution\" {} \"integer yresolution\" {}\n"
                    "PixelFilter \"box\"\nIntegrator \"path\" \"integer maxdepth\" 12\n"
                    "WorldBegin\nLightSource \"infinite\" \"rgb L\" [1 1 1]\n"
                    "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [30 30 30]\n"
                    "Material \"diffuse\" \"rgb reflectance\" [0 0 0]\nTranslate -3 -3 4\n"
                    "Shape \"sphere\" \"float radius\" 0.4\nAttributeEnd\n",
                    width, height) +
            metal("Cu", 0.1) + "AttributeBegin\nTranslate -1.45 -0.3 0.6\n" +
            "Shape \"sphere\" \"float radius\" 0.6\nAttributeEnd\n" + metal("Au", 0.05) +
            "AttributeBegin\nTranslate 0 -0.9 0.6\n" +
            "Shape \"sphere\" \"float radius\" 0.6\nAttributeEnd\n" + metal("Ag", 0.2) +
            "AttributeBegin\nTranslate 1.45 -0.3 0.6\n" +
            "Shape \"sphere\" \"float radius\" 0.6\nAttributeEnd\n" + metal("Cu", 0.1) +
            "AttributeBegin\nTranslate 0 1.1 1.2\nRotate 25 1 0 0\n" +
            "Shape \"sphere\" \"float radius\" 1 \"float zmax\" 0\nAttributeEnd\n" +
            "Material \"diffuse\" \"rgb reflectance\" [0.4 0.4 0.4]\n" +
            "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point3 P\" "
            "[-20 -20 0  20 -20 0  20 20 0  -20 20 0]\n",
        "metals.pbrt");
    const double luminance = spectrum_to_xyz(light)[1];
    const auto relight = [&](DenseSpectrum* of) {
        const double scale = spectrum_to_xyz(*of)[1] / luminance;
        for (int i = 0; i < spectrum_size; ++i) (*of)[i] = scale * light[i];
    };
    for (InfiniteLight& sky : scene.infinite_lights) relight(&sky.radiance);
    for (AreaLight& lamp : scene.area_lights) relight(&lamp.radiance);
    scene.warnings.clear();
    return scene;
}

Scene plates_under_lamps(int width, int height) {
    std::string world;
    // Lamps in a row across the picture, behind the camera's line of sight to the plates.
    const std::array<double, 3> radius = {0.05, 0.2, 0.6}, across = {-2.2, -0.4, 2.0};
    for (size_t i = 0; i < radius.size(); ++i) {
        world += fmt::format(
            "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [{0} {0} {0}]\n"
            "Material \"diffuse\" \"rgb reflectance\" [0 0 0]\nTranslate {1} 0 3\n"
            "Shape \"sphere\" \"float radius\" {2}\nAttributeEnd\n",
            1 / (radius[i] * radius[i]), across[i], radius[i]);
    }
    // The eye at (0, -9, 2.4) sees the lamps at z = 3 in plates at y = -3: their normal halves the
    // angle between the directions to both.
    const std::array<double, 4> beta = {0.005, 0.03, 0.1, 0.3}, up = {1.5, 0.8, 0.1, -0.6};
    for (size_t i = 0; i < beta.size(); ++i) {
        const double y = -2.5 - 0.35 * static_cast<double>(i);
        const double eye_y = -9 - y, eye_z = 2.4 - up[i], lamp_y = 0 - y, lamp_z = 3 - up[i];
        const double eye = std::hypot(eye_y, eye_z), lamp = std::hypot(lamp_y, lamp_z);
        const double tilt =
            std::atan2(-(eye_y / eye + lamp_y / lamp), eye_z / eye + lamp_z / lamp) * 180 / pi;
        world += fmt::format(
            "AttributeBegin\nMaterial \"conductor\" \"string material\" \"Al\" \"string lobe\" "
            "\"trowbridge-reitz\" \"float beta\" {}\nTranslate 0 {} {}\nRotate {} 1 0 0\n"
            "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point3 P\" "
            "[-3 -0.3 0  3 -0.3 0  3 0.3 0  -3 0.3 0]\nAttributeEnd\n",
            beta[i], y, up[i], tilt);
    }
    return parse_scene(
        fmt::format("LookAt 0 -9 2.4  0 -3 0.4  0 0 1\nCamera \"perspective\" \"float fov\" 28\n"
                    "Film \"rgb\" \"integer xresolution\" {} \"integer yresolution\" {}\n"
                    "PixelFilter \"box\"\nIntegrator \"path\" \"integer maxdepth\" 6\nWorldBegin\n",
                    width, height) +
            world,
        "plates.pbrt");
}

}  // namespace drude
