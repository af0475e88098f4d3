#include "render/albedo.h"

#include <algorithm>

#include "materials/surface.h"

namespace drude {

namespace {

constexpr int cosines = 257;
constexpr int phase = Wavelengths<spectral_bins>::spacing / 2;

int nanometres(int sample) {
    return Wavelengths<spectral_bins>::nanometres(phase, sample);
}

}  // namespace

struct Albedos::Reader {
    const Albedos& albedos;
    using Kind = Entry::Kind;

    static Value pack(const SpectrumValue& value) {
        return SpectrumTextures<spectral_bins>::pack(value);
    }
    Entry operator()(const DiffuseMaterial& m) const {
        Entry e;
        e.kind = Kind::diffuse;
        e.reflectance = pack(m.reflectance);
        return e;
    }
    Entry operator()(const DiffuseTransmissionMaterial& m) const {
        Entry e;
        e.kind = Kind::transmitting;
        e.reflectance = pack(m.reflectance);
        e.transmittance = pack(m.transmittance);
        return e;
    }
    Entry operator()(const ConductorMaterial& m) const {
        Entry e;
        e.kind = Kind::metal;
        e.metal = albedos.metal_of(m);
        return e;
    }
    Entry operator()(const DielectricMaterial&) const { return clear(); }
    Entry operator()(const ThinDielectricMaterial&) const { return clear(); }
    Entry operator()(const CoatedMaterial& m) const {
        return std::visit([&](const auto& base) { return (*this)(base); }, m.base);
    }
    Entry operator()(const MixMaterial& m) const {
        Entry e;
        e.kind = Kind::mix;
        e.first = m.first;
        e.second = m.second;
        e.amount = m.amount;
        return e;
    }
    Entry operator()(const OpticalElementMaterial&) const { return {}; }
    Entry operator()(const PluginMaterial&) const { return {}; }

    static Entry clear() {
        Entry e;
        e.kind = Kind::clear;
        return e;
    }
};

Albedos::Albedos(const Scene& scene) : numbers_(scene), spectra_(scene, numbers_) {
    glm::dvec3 white(0);
    for (int i = 0; i < spectrum_integral_size; ++i) {
        const double light = illuminant_d65()[i];
        const RGB rgb =
            xyz_to_rgb({light * cie1931().x[i], light * cie1931().y[i], light * cie1931().z[i]});
        const glm::dvec3 share(rgb[0], rgb[1], rgb[2]);
        weights_[i / Wavelengths<spectral_bins>::spacing] += share;
        white += share;
    }
    for (glm::dvec3& weight : weights_) weight /= white;
    for (const SurfaceMaterial& material : scene.materials) {
        entries_.push_back(std::visit(Reader{*this}, material));
    }
}

Albedos::Metal Albedos::metal_of(const ConductorMaterial& m) const {
    Metal metal;
    if (m.reflectance) {
        metal.fixed = true;
        metal.reflectance = Reader::pack(*m.reflectance);
        return metal;
    }
    for (int c = 0; c < cosines; ++c) {
        // At grazing everything is reflected; the cosine itself may not be 0.
        const double cosine = std::max(1e-6, static_cast<double>(c) / (cosines - 1));
        glm::dvec3 sum(0);
        for (int i = 0; i < spectral_bins; ++i) {
            sum += weights_[i] * reflect(m.surface, nanometres(i), cosine).A();
        }
        metal.by_cosine.push_back(sum);
    }
    return metal;
}

glm::dvec3 Albedos::colour(const Value& value, const TexturePoint& at) const {
    const Packet<spectral_bins> reflectance = spectra_.reflectance(value, at, phase);
    glm::dvec3 sum(0);
    for (int i = 0; i < spectral_bins; ++i) {
        sum += weights_[i] * static_cast<double>(reflectance[i]);
    }
    return sum;
}

glm::dvec3 Albedos::operator()(int material, const TexturePoint& at, double cos_theta) const {
    if (material < 0) return glm::dvec3(0);
    const Entry& e = entries_[material];
    switch (e.kind) {
        case Entry::Kind::none:
            break;
        case Entry::Kind::clear:
            return glm::dvec3(1);
        case Entry::Kind::diffuse:
            return colour(e.reflectance, at);
        case Entry::Kind::transmitting:
            return colour(e.reflectance, at) + colour(e.transmittance, at);
        case Entry::Kind::metal: {
            if (e.metal.fixed) return colour(e.metal.reflectance, at);
            const double x = std::clamp(cos_theta, 0.0, 1.0) * (cosines - 1);
            const int below = std::min(cosines - 2, static_cast<int>(x));
            return glm::mix(e.metal.by_cosine[below], e.metal.by_cosine[below + 1], x - below);
        }
        case Entry::Kind::mix: {
            const double second = numbers_.fraction(e.amount, at);
            return (1 - second) * (*this)(e.first, at, cos_theta) +
                   second * (*this)(e.second, at, cos_theta);
        }
    }
    return glm::dvec3(0);
}

}  // namespace drude
