// Material "tabulated_pbrdf" "string table" "FILE" [ "float scale" 1 ]
#include <drude/render/plugin_frames.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>

#include "table.h"

namespace {

using drude_plugin::cross;
using drude_plugin::dot;
using drude_plugin::normalised;
using drude_plugin::Vector;
using drude_plugin::vector;

constexpr float pi = 3.14159265358979f, degree = pi / 180;

// Half vectors in rings about the normal, the same density all over a ring: how often each is
// drawn follows the table.
class HalfVectorRings {
  public:
    explicit HalfVectorRings(const Table& table) {
        const size_t rings = table.theta_h_deg.size() - 1;
        const size_t row = table.values.size() / table.theta_h_deg.size();
        // Light from within 60 degrees of h: what comes nearer to grazing is bright, but rare.
        size_t near = 1;
        while (near < table.theta_d_deg.size() && table.theta_d_deg[near] <= 60) ++near;
        const size_t used = row / table.theta_d_deg.size() * near;
        std::vector<float> mean;
        for (size_t h = 0; h <= rings; ++h) {
            double sum = 0;
            for (size_t j = 0; j < used; j += 16) {
                sum += static_cast<double>(table.values[h * row + j]);
            }
            mean.push_back(static_cast<float>(sum / static_cast<double>(used / 16)));
        }
        float total = 0;
        for (size_t r = 0; r < rings; ++r) {
            const float inner = table.theta_h_deg[r] * degree,
                        outer = table.theta_h_deg[r + 1] * degree;
            Ring ring{std::cos(inner), std::cos(outer), 0, 0};
            const float mass =
                (mean[r] + mean[r + 1]) * std::cos((inner + outer) / 2) * (ring.inner - ring.outer);
            total += mass;
            ring.density = mass;
            rings_.push_back(ring);
        }
        float below = 0;
        for (Ring& ring : rings_) {
            const float share = total > 0 ? ring.density / total : 1 / static_cast<float>(rings);
            below += share;
            ring.cumulated = below;
            ring.density = share / (2 * pi * (ring.inner - ring.outer));
        }
        rings_.back().cumulated = 1;
    }

    // Per steradian of h.
    float density(float cos_h) const {
        for (const Ring& ring : rings_) {
            if (cos_h <= ring.inner && cos_h > ring.outer) return ring.density;
        }
        return 0;
    }
    Vector sample(float u, float v) const {
        size_t r = 0;
        while (r + 1 < rings_.size() && !(u < rings_[r].cumulated)) ++r;
        const float before = r > 0 ? rings_[r - 1].cumulated : 0;
        const float share = rings_[r].cumulated - before;
        const float part = share > 0 ? (u - before) / share : 0.5f;
        const float z = rings_[r].inner - part * (rings_[r].inner - rings_[r].outer);
        const float size = std::sqrt(std::max(0.0f, 1 - z * z));
        return {size * std::cos(2 * pi * v), size * std::sin(2 * pi * v), z};
    }

  private:
    struct Ring {
        float inner, outer;  // cosines; inner is the larger
        float density, cumulated;
    };
    std::vector<Ring> rings_;
};

struct Surface {
    Table table;
    HalfVectorRings rings;
    float scale = 1;
    explicit Surface(const std::string& path) : table(Table::read(path)), rings(table) {}
};

// Of the directions that are not drawn by their half vector.
constexpr float cosine_share = 0.1f;

void* create(const DrudeParameter* parameters, int32_t count, char* message, int32_t size) try {
    std::string path;
    float scale = 1;
    for (int32_t p = 0; p < count; ++p) {
        const std::string name = parameters[p].name;
        if (name == "table") path = parameters[p].strings[0];
        if (name == "scale") scale = static_cast<float>(parameters[p].numbers[0]);
    }
    if (path.empty()) throw std::runtime_error("no \"string table\"; expected the file of a pBRDF");
    if (!(scale >= 0)) throw std::runtime_error("scale is negative; expected 0 or more");
    auto surface = std::make_unique<Surface>(path);
    surface->scale = scale;
    return surface.release();
} catch (const std::exception& error) {
    std::snprintf(message, static_cast<size_t>(size), "%s", error.what());
    return nullptr;
}

void destroy(void* surface) {
    delete static_cast<Surface*>(surface);
}

void evaluate(const void* self, const DrudeDirections* d, const float* wavelengths_nm,
              int32_t count, float* mueller) {
    const Surface& surface = *static_cast<const Surface*>(self);
    const drude_plugin::HalfVectorFrames frames(*d);
    const Vector in = vector(d->in), h = frames.half();
    const float cos_d = std::min(1.0f, dot(in, h));
    // phi_d about h, from the direction away from the normal. Where h is the normal, or the light
    // comes along h, every azimuth is the same. Left-handed coordinates turn the other way.
    const Vector away = cross(cross({0, 0, 1}, h), h), side = d->handedness * cross(h, away);
    const float x = dot(in, away), y = dot(in, side);
    const float phi_d = x != 0 || y != 0 ? std::atan2(y, x) / degree : 0;
    surface.table.interpolate(std::acos(std::min(1.0f, h.z)) / degree, std::acos(cos_d) / degree,
                              phi_d, wavelengths_nm, count, mueller);
    for (int32_t w = 0; w < count; ++w) {
        float* m = mueller + 16 * w;
        for (int j = 0; j < 16; ++j) m[j] *= surface.scale * d->in[2];
        frames.to_ray_frames(m);
    }
}

float pdf(const void* self, const float out[3], const float in[3]) {
    const Surface& surface = *static_cast<const Surface*>(self);
    const Vector h = normalised(vector(in) + vector(out));
    const float cos_d = dot(vector(out), h);
    // Walter et al. 2007, equation 14: from half vectors to directions.
    const float lobe = cos_d > 0 ? surface.rings.density(h.z) / (4 * cos_d) : 0;
    return cosine_share * in[2] / pi + (1 - cosine_share) * lobe;
}

int32_t sample(const void* self, const float out[3], const float u[3], float in[3],
               float* density) {
    const Surface& surface = *static_cast<const Surface*>(self);
    Vector i;
    if (u[2] < cosine_share) {
        const float r = std::sqrt(u[0]);
        i = {r * std::cos(2 * pi * u[1]), r * std::sin(2 * pi * u[1]), std::sqrt(1 - u[0])};
    } else {
        const Vector o = vector(out), h = surface.rings.sample(u[0], u[1]);
        if (!(dot(o, h) > 0)) return 0;
        i = 2 * dot(o, h) * h + -o;
    }
    if (!(i.z > 0)) return 0;
    in[0] = i.x;
    in[1] = i.y;
    in[2] = i.z;
    *density = pdf(self, out, in);
    return *density > 0;
}

const char* const parameters[] = {"file table", "float scale", nullptr};
const DrudeSurfacePlugin plugin = {DRUDE_PLUGIN_VERSION,
                                   sizeof(DrudeSurfacePlugin),
                                   DRUDE_INSTRUCTION_SET,
                                   "isotropic polarised BRDF, interpolated in a table",
                                   parameters,
                                   create,
                                   destroy,
                                   evaluate,
                                   sample,
                                   pdf};

}  // namespace

const DrudeSurfacePlugin* drude_surface_plugin(void) {
    return &plugin;
}
