#include "check_scene.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace drude {

namespace {

void require(bool holds, const char* what) {
    if (holds) return;
    std::fprintf(stderr, "ERROR: a scene was read in which this does not hold: %s\n", what);
    std::abort();
}

bool within(double value, double lowest, double highest) {
    return value >= lowest && value <= highest;
}

bool finite(const glm::dmat4& matrix) {
    for (int i = 0; i < 16; ++i) {
        if (!std::isfinite(matrix[i / 4][i % 4])) return false;
    }
    return true;
}

bool is_unit(const glm::dvec3& v) {
    return std::abs(v.x * v.x + v.y * v.y + v.z * v.z - 1) < 1e-6;
}

void check_spectrum(const DenseSpectrum& spectrum, double lowest, double highest,
                    const char* what) {
    for (const double value : spectrum) require(within(value, lowest, highest), what);
}

class Checker {
  public:
    explicit Checker(const Scene& scene) : scene_(scene) {}

    void run() {
        settings();
        size_t index = 0;
        for (const Texture<NumberValue>& t : scene_.number_textures) texture(t, index++);
        index = 0;
        for (const Texture<SpectrumValue>& t : scene_.spectrum_textures) texture(t, index++);
        for (const SurfaceMaterial& m : scene_.materials) {
            std::visit([&](const auto& material) { check(material); }, m);
        }
        for (const Shape& s : scene_.shapes) shape(s);
        lights();
    }

  private:
    void settings() const {
        const Film& film = scene_.film;
        require(film.width > 0 && film.height > 0, "a film has pixels");
        require(finite(scene_.camera.world_from_camera), "the camera's matrix is finite");
        const double* window = scene_.camera.screen_window;
        for (int i = 0; i < 4; i += 2) {
            require(std::isfinite(window[i + 1] - window[i]) && window[i] < window[i + 1],
                    "the screen window ascends");
        }
        require(within(scene_.camera.lens_radius, 0, 1e9), "a lens has a radius");
        require(scene_.samples_per_pixel > 0 && scene_.max_depth >= 0, "samples and depth");
        require(within(scene_.filter.radius_x, 1e-6, 1e6), "a filter has a width");
        require(within(scene_.filter.radius_y, 1e-6, 1e6), "a filter has a height");
    }

    // `behind` it there may be textures of the list, as many as it has before it.
    void operand(const NumberValue& value, size_t behind) const {
        require(value.texture < static_cast<int>(behind), "a texture is made of those before it");
        require(std::abs(value.constant) <= 1e15, "a texture's number is in range");
    }
    void operand(const SpectrumValue& value, size_t behind) const {
        require(value.texture < static_cast<int>(behind), "a texture is made of those before it");
        check_spectrum(value.constant, -1e15, 1e15, "a texture's spectrum is in range");
    }
    void any(const NumberValue& value) const { operand(value, scene_.number_textures.size()); }
    void any(const SpectrumValue& value) const { operand(value, scene_.spectrum_textures.size()); }

    void mapping(const TextureMapping& mapping) const {
        require(finite(mapping.texture_from_world), "a mapping's matrix is finite");
        require(std::isfinite(mapping.scale_u + mapping.scale_v), "a mapping's scale is finite");
    }

    template <class Value>
    void texture(const Texture<Value>& any_texture, size_t index) const {
        std::visit([&](const auto& t) { parts<Value>(t, index); }, any_texture);
    }
    template <class Value>
    void parts(const ConstantTexture<Value>& t, size_t index) const {
        operand(t.value, index);
    }
    template <class Value>
    void parts(const ImageTexture& t, size_t) const {
        mapping(t.mapping);
    }
    template <class Value>
    void parts(const CheckerboardTexture<Value>& t, size_t index) const {
        mapping(t.mapping);
        operand(t.first, index);
        operand(t.second, index);
    }
    template <class Value>
    void parts(const ScaleTexture<Value>& t, size_t index) const {
        operand(t.texture, index);
        number_operand<Value>(t.scale, index);
    }
    template <class Value>
    void parts(const MixTexture<Value>& t, size_t index) const {
        operand(t.first, index);
        operand(t.second, index);
        number_operand<Value>(t.amount, index);
    }
    template <class Value>
    void parts(const BilerpTexture<Value>& t, size_t) const {
        mapping(t.mapping);
        for (const Value* corner : {&t.v00, &t.v01, &t.v10, &t.v11}) operand(*corner, 0);
    }
    template <class Value>
    void parts(const DirectionMixTexture<Value>& t, size_t index) const {
        operand(t.first, index);
        operand(t.second, index);
        require(is_unit(t.direction), "a texture's direction is a unit vector");
    }
    // A number in a spectrum texture may be any of the other list.
    template <class Value>
    void number_operand(const NumberValue& value, size_t index) const {
        operand(value, std::is_same_v<Value, NumberValue> ? index : scene_.number_textures.size());
    }

    void reflectance(const SpectrumValue& value) const {
        any(value);
        if (value.texture < 0) {
            check_spectrum(value.constant, 0, 1 + 1e-6, "a reflectance is in [0, 1]");
        }
    }
    void eta(const DenseSpectrum& spectrum) const {
        check_spectrum(spectrum, 1e-3, 1e3, "a refractive index is finite");
    }
    void check(const ConductorMaterial& m) const {
        m.surface.check();
        require(m.alpha == -1 || within(m.alpha, 0, 10), "alpha is in range");
        if (m.textured_roughness) any(m.textured_roughness->roughness);
        if (m.reflectance) reflectance(*m.reflectance);
    }
    void check(const DiffuseMaterial& m) const { reflectance(m.reflectance); }
    void check(const DiffuseTransmissionMaterial& m) const {
        reflectance(m.reflectance);
        reflectance(m.transmittance);
    }
    void check(const DielectricMaterial& m) const {
        eta(m.eta);
        require(within(m.alpha, 0, 10), "alpha is in range");
    }
    void check(const ThinDielectricMaterial& m) const { eta(m.eta); }
    void check(const CoatedMaterial& m) const {
        eta(m.eta);
        require(within(m.alpha, 0, 10) && within(m.thickness, 0, 1e6), "a coat is in range");
        std::visit([&](const auto& base) { check(base); }, m.base);
    }
    void check(const MixMaterial& m) const {
        material(m.first);
        material(m.second);
        any(m.amount);
    }
    void check(const OpticalElementMaterial& m) const {
        require(within(m.transmittance, 0, 1), "an element's transmittance is in [0, 1]");
        require(std::isfinite(m.axis_deg + m.retardance_deg), "an element's angles are finite");
    }
    void check(const PluginMaterial& m) const {
        require(m.surface != nullptr, "a plugin has its surface");
    }
    void material(int index) const {
        require(index >= -1 && index < static_cast<int>(scene_.materials.size()),
                "a material's index points at one");
    }

    void shape(const Shape& s) const {
        material(s.material);
        require(s.area_light >= -1 && s.area_light < static_cast<int>(scene_.area_lights.size()),
                "an area light's index points at one");
        require(finite(s.world_from_object), "a shape's matrix is finite");
        std::visit([&](const auto& geometry) { check(geometry); }, s.geometry);
    }
    void check(const Sphere& s) const {
        require(s.radius > 0 && s.z_min < s.z_max && within(s.phi_max_deg, 1e-9, 360),
                "something is left of a sphere");
    }
    void check(const Disk& s) const {
        require(s.radius > 0 && within(s.inner_radius, 0, s.radius), "something is left of a disk");
    }
    void check(const Cylinder& s) const {
        require(s.radius > 0 && s.z_min < s.z_max, "something is left of a cylinder");
    }
    void check(const TriangleMesh& mesh) const {
        const size_t count = mesh.positions.size();
        require(!mesh.triangles.empty(), "a mesh has triangles");
        require(mesh.normals.empty() || mesh.normals.size() == count, "normals for all or none");
        require(mesh.uv.empty() || mesh.uv.size() == count, "uv for all or none");
        for (const glm::uvec3& t : mesh.triangles) {
            require(t.x < count && t.y < count && t.z < count, "triangles have vertices");
        }
        for (const glm::vec3& p : mesh.positions) {
            require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z),
                    "vertices are finite");
        }
        for (const glm::vec3& n : mesh.normals) {
            require(std::isfinite(n.x) && std::isfinite(n.y) && std::isfinite(n.z),
                    "normals are finite");
        }
    }

    void polarisation(const LightPolarisation& p) const {
        require(within(p.dop, 0, 1) && std::isfinite(p.aolp_deg), "polarisation is in range");
    }
    void lights() const {
        constexpr double most = 1e20;
        for (const InfiniteLight& light : scene_.infinite_lights) {
            check_spectrum(light.radiance, 0, most, "radiance is 0 or more");
            require(finite(light.world_from_light), "a light's matrix is finite");
            polarisation(light.polarisation);
            if (light.rayleigh) {
                require(is_unit(light.rayleigh->sun), "the sun stands in a direction");
                require(within(light.rayleigh->maximum, 0, 1), "polarisation is in range");
            }
        }
        for (const DistantLight& light : scene_.distant_lights) {
            check_spectrum(light.irradiance, 0, most, "irradiance is 0 or more");
            require(is_unit(light.direction) && is_unit(light.x_axis), "a light has a direction");
            polarisation(light.polarisation);
        }
        for (const PointLight& light : scene_.point_lights) {
            check_spectrum(light.intensity, 0, most, "intensity is 0 or more");
            require(is_unit(light.axis) && is_unit(light.x_axis), "a spot has a direction");
            require(within(light.cos_end, -1, 1) && within(light.cos_start, light.cos_end, 1),
                    "a spot's cone is one");
            polarisation(light.polarisation);
        }
        for (const AreaLight& light : scene_.area_lights) {
            check_spectrum(light.radiance, 0, most, "radiance is 0 or more");
            polarisation(light.polarisation);
        }
    }

    const Scene& scene_;
};

}  // namespace

void check_scene(const Scene& scene) {
    Checker(scene).run();
}

}  // namespace drude
