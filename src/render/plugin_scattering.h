// A plugin's surface at one vertex of a path: the members of surface_scattering.h over float
// arrays. What a plugin gives is checked before anything is multiplied with it, so that one that
// is wrong costs its own light and nothing else.
#pragma once

#include "render/surface_scattering.h"
#include "render/vertex.h"

namespace drude {

// A Mueller matrix a wavelength, without structure.
template <int N>
struct DenseOptics {
    Mueller<Packet<N>> mueller;
    glm::vec3 x_in;  // world: its columns are in the frame of this x axis
};

// What plugins did that no surface does.
struct PluginFaults {
    uint64_t& unphysical;  // matrices with |M_ij| > M_00
    uint64_t& not_finite;  // matrices, directions or densities that are not numbers or not possible
};

template <int N>
class PluginScattering {
  public:
    static constexpr bool depolarises = false;

    // `x_out`: x axis of the frame on the ray along v.out, world.
    PluginScattering(const PluginTables<N>& plugin, int phase, const Vertex& v,
                     const glm::vec3& x_out, float handedness, PluginFaults faults)
        : plugin_(plugin),
          wavelengths_nm_(&plugin.nanometres[static_cast<size_t>(phase) * N]),
          v_(v),
          x_out_(v.to_local(x_out)),
          handedness_(handedness),
          faults_(faults) {}

    bool is_delta() const { return false; }

    // The density of light, of which the value is 1: everything else is in the matrix.
    LobeValue evaluate(const glm::vec3& o, const glm::vec3& i) const {
        if (!(o.z > 0 && i.z > 0)) return {};
        const float pdf = plugin_.surface->pdf(&o.x, &i.x);
        if (!(pdf >= 0 && pdf < std::numeric_limits<float>::infinity())) {
            ++faults_.not_finite;
            return {};
        }
        return {1, pdf, {0, 0, 1}, false};
    }

    LobeSample sample(const glm::vec3& o, Sampler& sampler) const {
        LobeSample s;
        const glm::vec2 u2 = sampler.next_2d();
        const float u[3] = {u2.x, u2.y, sampler.next_1d()};
        if (!(o.z > 0)) return s;
        float in[3] = {0, 0, 0}, pdf = 0;
        if (!plugin_.surface->sample(&o.x, u, in, &pdf)) return s;
        s.i = {in[0], in[1], in[2]};
        const float size2 = glm::dot(s.i, s.i);
        if (!(std::abs(size2 - 1) < 1e-3f && pdf > 0 &&
              1 / pdf < std::numeric_limits<float>::infinity() &&
              pdf < std::numeric_limits<float>::infinity())) {
            ++faults_.not_finite;
            return s;
        }
        if (!(s.i.z > 0)) return s;
        s.pdf = pdf;
        s.weight = 1 / pdf;
        return s;
    }

    DenseOptics<N> optics(const glm::vec3& o, const glm::vec3& i, const glm::vec3&, bool) const {
        const glm::vec3 x_in = any_perpendicular(i);
        const DrudeDirections directions{{o.x, o.y, o.z},
                                         {i.x, i.y, i.z},
                                         {x_out_.x, x_out_.y, x_out_.z},
                                         {x_in.x, x_in.y, x_in.z},
                                         handedness_};
        float elements[16 * N];
        std::fill(std::begin(elements), std::end(elements), 0.0f);
        plugin_.surface->evaluate(directions, wavelengths_nm_, N, elements);
        DenseOptics<N> result;
        result.x_in = v_.to_world(x_in);
        make_physical(elements);
        for (int row = 0; row < 4; ++row) {
            for (int column = 0; column < 4; ++column) {
                Packet<N>& packet = result.mueller.m[row][column];
                for (int lane = 0; lane < N; ++lane) {
                    packet.set(lane, elements[16 * lane + 4 * row + column]);
                }
            }
        }
        return result;
    }

  private:
    // Roulette, MIS and the other wavelengths rest on finite numbers and |M_ij| <= M_00.
    void make_physical(float (&elements)[16 * N]) const {
        // Rotating a frame in float moves an element by a few roundings.
        constexpr float slack = 1e-4f;
        for (int lane = 0; lane < N; ++lane) {
            float* m = elements + 16 * lane;
            float size = 0;
            for (int j = 1; j < 16; ++j) size += std::abs(m[j]);
            // A sum of sizes is finite where each of them is, but for an overflow.
            if (!(size < std::numeric_limits<float>::infinity() &&
                  std::abs(m[0]) < std::numeric_limits<float>::infinity())) {
                ++faults_.not_finite;
                std::fill(m, m + 16, 0.0f);
                continue;
            }
            const float largest = std::max(m[0], 0.0f);
            float excess = -m[0];
            for (int j = 1; j < 16; ++j) excess = std::max(excess, std::abs(m[j]) - largest);
            if (excess > slack * largest) ++faults_.unphysical;
            m[0] = largest;
            for (int j = 1; j < 16; ++j) m[j] = std::clamp(m[j], -largest, largest);
        }
    }

    const PluginTables<N>& plugin_;
    const float* wavelengths_nm_;
    const Vertex& v_;
    glm::vec3 x_out_;
    float handedness_;
    PluginFaults faults_;
};

}  // namespace drude
