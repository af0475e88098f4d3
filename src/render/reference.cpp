#include "render/reference.h"

#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "base/counter_random.h"
#include "base/executor.h"
#include "materials/surface.h"
#include "materials/torrance_sparrow.h"
#include "render/reference_camera.h"
#include "render/reference_geometry.h"
#include "render/reference_light.h"
#include "scene/plugin_surface.h"

namespace drude {

namespace {

using Vec = glm::dvec3;
using Matrix = Mueller<double>;

// Uniform numbers in [0, 1): a stream for each path.
class Random {
  public:
    Random(uint64_t seed, uint64_t pixel, uint64_t sample) : key_(seed) {
        counter_ = {static_cast<uint32_t>(pixel), static_cast<uint32_t>(pixel >> 32),
                    static_cast<uint32_t>(sample), 0};
    }
    double operator()() {
        const PhiloxBlock bits =
            philox(counter_, {static_cast<uint32_t>(key_), static_cast<uint32_t>(key_ >> 32)});
        ++counter_[3];
        return static_cast<double>((uint64_t{bits[0]} << 32 | bits[1]) >> 11) * 0x1p-53;
    }

  private:
    uint64_t key_;
    PhiloxBlock counter_;
};

class ReferenceTracer {
  public:
    ReferenceTracer(const Scene& scene, const ReferenceOptions& options)
        : scene_(scene),
          options_(options),
          geometry_(scene),
          camera_(scene),
          handedness_(camera_.handedness()) {
        for (const InfiniteLight& light : scene.infinite_lights) skies_.emplace_back(light);
        for (const SurfaceMaterial& material : scene.materials) {
            lobes_.emplace_back();
            const auto* metal = std::get_if<ConductorMaterial>(&material);
            if (!metal) continue;
            const Material& s = metal->surface;
            lobes_.back() = metal->alpha >= 0
                                ? Microfacets<double>::from_alpha(metal->alpha, s.masking)
                                : Microfacets<double>(s.lobe, s.masking, s.beta);
        }
    }

    // S0..S3 at each of `nm` for one camera ray through (x, y) in pixels.
    std::vector<Stokes<double>> trace(double x, double y, const std::vector<double>& nm,
                                      Random& random, uint64_t* rays) const {
        const bool lens = camera_.has_lens();
        const double u1 = lens ? random() : 0, u2 = lens ? random() : 0;
        const ReferenceRay ray = camera_.ray(x, y, u1, u2);
        Vec o = ray.o, d = ray.d;
        // The x axis of the frame on the ray that is being followed, which light travels along -d.
        Vec frame = ray.horizontal;

        std::vector<Stokes<double>> sum(nm.size(), Stokes<double>{{0, 0, 0, 0}});
        std::vector<Matrix> path(nm.size(), Matrix::identity());
        const auto add = [&](size_t i, const Matrix& m, double radiance,
                             const Stokes<double>& stokes) {
            const Stokes<double> seen = m * stokes;
            for (int row = 0; row < 4; ++row) sum[i][row] += seen[row] * radiance;
        };
        int from = -1;
        for (int depth = 0;; ++depth) {
            ReferenceHit hit;
            ++*rays;
            if (!geometry_.intersect(o, d, from, &hit)) {
                for (const ReferenceSky& sky : skies_) {
                    const Stokes<double> stokes = sky.stokes(d, frame, handedness_);
                    for (size_t i = 0; i < nm.size(); ++i) {
                        add(i, path[i], sky.radiance(d, nm[i]), stokes);
                    }
                }
                return sum;
            }
            const Shape& shape = scene_.shapes[hit.shape];
            if (shape.area_light >= 0) {
                const AreaLight& light = scene_.area_lights[shape.area_light];
                if (light.two_sided || glm::dot(hit.ng, d) < 0) {
                    const Stokes<double> stokes =
                        emitted_stokes(light.polarisation, Vec(shape.world_from_object[0]), -d,
                                       frame, handedness_);
                    for (size_t i = 0; i < nm.size(); ++i) {
                        add(i, path[i], spectrum_at(light.radiance, nm[i]), stokes);
                    }
                }
            }
            if (depth == scene_.max_depth) return sum;
            const Vec out = -d;
            if (glm::dot(hit.ng, out) < 0) hit.ng = -hit.ng, hit.ns = -hit.ns;
            if (glm::dot(hit.ns, out) <= 0) hit.ns = hit.ng;

            // Light without size: `irradiance` across the ray, at the wavelength of its argument,
            // from the direction `in`, which is free where nothing stands within `distance`.
            const auto add_delta = [&](const Vec& in, double distance, const Vec& zero,
                                       const LightPolarisation& polarisation,
                                       const auto& irradiance) {
                if (!(glm::dot(in, hit.ng) > 0) || is_mirror(shape.material)) return;
                ReferenceHit blocker;
                ++*rays;
                if (geometry_.intersect(hit.p, in, hit.primitive, &blocker) &&
                    blocker.t < distance) {
                    return;
                }
                const Vec in_frame = any_perpendicular(in);
                const Stokes<double> stokes =
                    emitted_stokes(polarisation, zero, -in, in_frame, handedness_);
                for (size_t i = 0; i < nm.size(); ++i) {
                    const Matrix m =
                        scatter(shape.material, nm[i], hit.ns, in, in_frame, out, frame);
                    add(i, path[i] * m, irradiance(nm[i]), stokes);
                }
            };
            for (const DistantLight& light : scene_.distant_lights) {
                add_delta(-light.direction, INFINITY, light.x_axis, light.polarisation,
                          [&](double at_nm) { return spectrum_at(light.irradiance, at_nm); });
            }
            for (const PointLight& light : scene_.point_lights) {
                const Vec to = light.position - hit.p;
                const double distance = glm::length(to);
                add_delta(to / distance, (1 - 1e-4) * distance, light.x_axis, light.polarisation,
                          [&](double at_nm) {
                              return intensity_towards(light, hit.p, at_nm) / (distance * distance);
                          });
            }

            Vec in, facet(0.0);
            const double weight = choose(shape.material, hit.ns, out, random, &in, &facet);
            if (!(weight > 0) || !(glm::dot(in, hit.ng) > 0)) return sum;
            // A frame that has nothing to do with the plane of incidence.
            const Vec in_frame = any_perpendicular(in);
            for (size_t i = 0; i < nm.size(); ++i) {
                Matrix m =
                    glm::length(facet) > 0
                        ? facet_matrix(shape.material, nm[i], facet, in, in_frame, out, frame)
                        : scatter(shape.material, nm[i], hit.ns, in, in_frame, out, frame);
                for (auto& row : m.m) {
                    for (double& element : row) element *= weight;
                }
                path[i] = path[i] * m;
            }
            o = hit.p;
            d = in;
            frame = in_frame;
            from = hit.primitive;
        }
    }

  private:
    bool is_mirror(int material) const {
        return std::holds_alternative<ConductorMaterial>(scene_.materials[material]) &&
               lobes_[material].is_mirror();
    }

    Reflection<double> facet_reflection(int material, double nm, double cosine) const {
        const auto& metal = std::get<ConductorMaterial>(scene_.materials[material]);
        if (metal.reflectance) {
            const double r = spectrum_at(metal.reflectance->constant, nm);
            return {r, r, -r, 0};
        }
        return reflect(metal.surface, nm, cosine);
    }

    // The Mueller matrix of one facet of normal m between the frames.
    Matrix facet_matrix(int material, double nm, const Vec& m, const Vec& in, const Vec& in_frame,
                        const Vec& out, const Vec& out_frame) const {
        const Vec s = s_axis(-in, m);
        const Rotation<double> to_s = rotation_between(-in, in_frame, s, handedness_);
        const Rotation<double> from_s = inverse(rotation_between(out, out_frame, s, handedness_));
        const double cosine = std::min(1.0, glm::dot(in, m));
        return mueller(from_s) * mueller(facet_reflection(material, nm, cosine)) * mueller(to_s);
    }

    // The surface's Mueller matrix from `in` to `out` times cos_in, per solid angle.
    Matrix scatter(int material, double nm, const Vec& n, const Vec& in, const Vec& in_frame,
                   const Vec& out, const Vec& out_frame) const {
        const double cosine = glm::dot(in, n);
        if (const auto* diffuse = std::get_if<DiffuseMaterial>(&scene_.materials[material])) {
            const double r =
                cosine > 0 ? spectrum_at(diffuse->reflectance.constant, nm) * cosine / pi : 0;
            return Matrix::diagonal(r, 0, 0, 0);
        }
        if (const auto* plugin = std::get_if<PluginMaterial>(&scene_.materials[material])) {
            return plugin_matrix(*plugin->surface, nm, n, in, in_frame, out, out_frame);
        }
        const auto e = lobes_[material].evaluate(to_local(n, out), to_local(n, in));
        if (!(e.value > 0)) return Matrix::diagonal(0, 0, 0, 0);
        Matrix m =
            facet_matrix(material, nm, glm::normalize(in + out), in, in_frame, out, out_frame);
        for (auto& row : m.m) {
            for (double& element : row) element *= e.value;
        }
        return m;
    }

    Matrix plugin_matrix(const PluginSurface& surface, double nm, const Vec& n, const Vec& in,
                         const Vec& in_frame, const Vec& out, const Vec& out_frame) const {
        if (!(glm::dot(in, n) > 0)) return Matrix::diagonal(0, 0, 0, 0);
        const glm::vec3 o(to_local(n, out)), i(to_local(n, in)), x_o(to_local(n, out_frame)),
            x_i(to_local(n, in_frame));
        const DrudeDirections directions{{o.x, o.y, o.z},
                                         {i.x, i.y, i.z},
                                         {x_o.x, x_o.y, x_o.z},
                                         {x_i.x, x_i.y, x_i.z},
                                         static_cast<float>(handedness_)};
        const float wavelength = static_cast<float>(nm);
        float elements[16] = {};
        surface.evaluate(directions, &wavelength, 1, elements);
        Matrix m;
        for (int row = 0; row < 4; ++row) {
            for (int column = 0; column < 4; ++column) {
                m.m[row][column] = static_cast<double>(elements[4 * row + column]);
            }
        }
        return m;
    }

    // A direction for the path and what it is worth. With a facet (not zero), the weight is the
    // scattering over the density without the facet's own reflection; otherwise it is one over the
    // density.
    double choose(int material, const Vec& n, const Vec& out, Random& random, Vec* in,
                  Vec* facet) const {
        const Vec tangent = any_perpendicular(n), bitangent = glm::cross(n, tangent);
        const auto to_world = [&](const Vec& v) {
            return glm::normalize(v.x * tangent + v.y * bitangent + v.z * n);
        };
        if (is_mirror(material)) {
            *facet = n;
            *in = glm::normalize(2 * glm::dot(out, n) * n - out);
            return 1;
        }
        const double u1 = random(), u2 = random(), u3 = random();
        const bool is_diffuse = std::holds_alternative<DiffuseMaterial>(scene_.materials[material]);
        if (options_.directions == ReferenceOptions::Directions::hemisphere || is_diffuse) {
            // Uniform: cos = u1; in proportion to the cosine: cos^2 = u1.
            const bool uniform = options_.directions == ReferenceOptions::Directions::hemisphere;
            const double z = uniform ? u1 : std::sqrt(u1), r = std::sqrt(1 - z * z);
            *in = to_world({r * std::cos(2 * pi * u2), r * std::sin(2 * pi * u2), z});
            if (!(z > 0)) return 0;
            return uniform ? 2 * pi : pi / z;
        }
        if (const auto* plugin = std::get_if<PluginMaterial>(&scene_.materials[material])) {
            const glm::vec3 o(to_local(n, out));
            // Below 1 in float too.
            const auto below_one = [](double v) {
                return std::min(static_cast<float>(v), 0x1.fffffep-1f);
            };
            const float u[3] = {below_one(u1), below_one(u2), below_one(u3)};
            glm::vec3 i(0);
            float pdf = 0;
            if (!plugin->surface->sample(&o.x, u, &i.x, &pdf) || !(pdf > 0)) return 0;
            *in = to_world(Vec(i));
            return 1 / static_cast<double>(pdf);
        }
        const auto s = lobes_[material].sample(to_local(n, out), u1, u2, u3);
        *in = to_world(s.i);
        *facet = to_world(s.m);
        return s.pdf > 0 ? s.weight : 0;
    }

    static Vec to_local(const Vec& n, const Vec& v) {
        const Vec tangent = any_perpendicular(n);
        return {glm::dot(v, tangent), glm::dot(v, glm::cross(n, tangent)), glm::dot(v, n)};
    }

    const Scene& scene_;
    const ReferenceOptions& options_;
    ReferenceGeometry geometry_;
    ReferenceCamera camera_;
    std::vector<ReferenceSky> skies_;
    std::vector<Microfacets<double>> lobes_;  // by material
    double handedness_;
};

void check(const Scene& scene, const ReferenceOptions& options) {
    if (scene.filter.kind != FilterKind::box) {
        user_error("the reference integrator knows box filters only; use PixelFilter \"box\"");
    }
    if (options.samples_per_pixel < 2) {
        user_error("{} samples a pixel; expected at least 2, for a standard error",
                   options.samples_per_pixel);
    }
    if (options.bands_nm.empty()) user_error("no band of wavelengths; expected at least one");
    for (const auto& band : options.bands_nm) {
        if (band.empty()) user_error("a band without wavelengths; expected at least one");
        for (const double nm : band) {
            if (!(nm >= spectrum_first_nm && nm <= spectrum_last_nm)) {
                user_error("a wavelength of {} nm; expected {} to {}", nm, spectrum_first_nm,
                           spectrum_last_nm);
            }
        }
    }
}

}  // namespace

ReferenceResult render_reference(const Scene& scene, const ReferenceOptions& options) {
    check(scene, options);
    const ReferenceTracer tracer(scene, options);
    ReferenceResult result;
    result.width = scene.film.width;
    result.height = scene.film.height;
    result.bands = static_cast<int>(options.bands_nm.size());
    const size_t bands = options.bands_nm.size();
    const size_t pixels = static_cast<size_t>(result.width) * static_cast<size_t>(result.height);
    result.values.resize(pixels * bands);
    std::atomic<uint64_t> rays{0};
    parallel_for(pixels, options.threads, [&](size_t pixel) {
        const int n = options.samples_per_pixel;
        std::vector<std::array<double, 4>> sum(bands), squares(bands);
        std::vector<double> nm(bands);
        uint64_t own_rays = 0;
        for (int sample = 0; sample < n; ++sample) {
            Random random(options.seed, pixel, static_cast<uint64_t>(sample));
            const double dx = (2 * random() - 1) * scene.filter.radius_x;
            const double dy = (2 * random() - 1) * scene.filter.radius_y;
            for (size_t b = 0; b < bands; ++b) {
                const auto& band = options.bands_nm[b];
                nm[b] = band[static_cast<size_t>(random() * static_cast<double>(band.size()))];
            }
            const auto stokes = tracer.trace(
                static_cast<double>(pixel % static_cast<size_t>(result.width)) + 0.5 + dx,
                static_cast<double>(pixel / static_cast<size_t>(result.width)) + 0.5 + dy, nm,
                random, &own_rays);
            for (size_t b = 0; b < bands; ++b) {
                for (int i = 0; i < 4; ++i) {
                    sum[b][i] += stokes[b][i];
                    squares[b][i] += stokes[b][i] * stokes[b][i];
                }
            }
        }
        for (size_t b = 0; b < bands; ++b) {
            ReferenceResult::Value& value = result.values[pixel * bands + b];
            for (int i = 0; i < 4; ++i) {
                value.mean[i] = sum[b][i] / n;
                const double spread = squares[b][i] / n - value.mean[i] * value.mean[i];
                value.standard_error[i] = std::sqrt(std::max(0.0, spread) / (n - 1));
            }
        }
        rays += own_rays;
    });
    result.rays = rays;
    return result;
}

}  // namespace drude
