#include "render/reference.h"

#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>

#include "base/executor.h"
#include "materials/frame.h"
#include "render/reference_camera.h"
#include "render/reference_geometry.h"
#include "render/reference_light.h"
#include "render/reference_random.h"
#include "render/reference_surface.h"

namespace drude {

namespace {

using Vec = glm::dvec3;
using Matrix = Mueller<double>;

class ReferenceTracer {
  public:
    ReferenceTracer(const Scene& scene, const ReferenceOptions& options)
        : scene_(scene),
          geometry_(scene),
          camera_(scene),
          handedness_(camera_.handedness()),
          surfaces_(scene, options.directions, handedness_) {
        for (const InfiniteLight& light : scene.infinite_lights) skies_.emplace_back(light);
    }

    // S0..S3 at each of `nm` for one camera ray through (x, y) in pixels. Where refraction parts
    // the wavelengths, a path has one of them, for all.
    std::vector<Stokes<double>> trace(double x, double y, const std::vector<double>& nm,
                                      ReferenceRandom& random, uint64_t* rays) const {
        if (!surfaces_.is_dispersive()) return path(x, y, nm, random, rays);
        const auto only = static_cast<size_t>(random() * static_cast<double>(nm.size()));
        std::vector<Stokes<double>> sum(nm.size(), Stokes<double>{{0, 0, 0, 0}});
        sum[only] = path(x, y, {nm[only]}, random, rays)[0];
        for (double& s : sum[only].s) s *= static_cast<double>(nm.size());
        return sum;
    }

  private:
    std::vector<Stokes<double>> path(double x, double y, const std::vector<double>& nm,
                                     ReferenceRandom& random, uint64_t* rays) const {
        const bool lens = camera_.has_lens();
        const double u1 = lens ? random() : 0, u2 = lens ? random() : 0;
        const ReferenceRay ray = camera_.ray(x, y, u1, u2);
        Vec o = ray.o, d = ray.d;
        // The x axis of the frame on the ray that is being followed, which light travels along -d.
        Vec frame = ray.horizontal;

        std::vector<Stokes<double>> sum(nm.size(), Stokes<double>{{0, 0, 0, 0}});
        std::vector<Matrix> product(nm.size(), Matrix::identity());
        const auto add = [&](size_t i, const Matrix& m, double radiance,
                             const Stokes<double>& stokes) {
            const Stokes<double> seen = m * stokes;
            for (int row = 0; row < 4; ++row) sum[i][row] += seen[row] * radiance;
        };
        int from = -1, straight = 0;
        for (int depth = 0;;) {
            ReferenceHit hit;
            ++*rays;
            if (!geometry_.intersect(o, d, from, &hit)) {
                for (const ReferenceSky& sky : skies_) {
                    const Stokes<double> stokes = sky.stokes(d, frame, handedness_);
                    for (size_t i = 0; i < nm.size(); ++i) {
                        add(i, product[i], sky.radiance(d, nm[i]), stokes);
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
                        add(i, product[i], spectrum_at(light.radiance, nm[i]), stokes);
                    }
                }
            }
            const int material = surfaces_.chosen(shape.material, random);
            if (material < 0 || surfaces_.is_element(material)) {
                if (material >= 0) {
                    const Matrix m = surfaces_.element(material, Vec(shape.world_from_object[0]),
                                                       hit.ng, -d, frame);
                    for (Matrix& m_so_far : product) m_so_far = m_so_far * m;
                }
                if (++straight == most_straight) return sum;
                o = hit.p;
                from = hit.primitive;
                continue;
            }
            if (depth++ == scene_.max_depth) return sum;
            ReferenceVertex vertex{hit.ns, -d, frame, glm::dot(hit.ng, d) <= 0};
            if (!vertex.front) hit.ng = -hit.ng, vertex.n = -hit.ns;
            if (glm::dot(vertex.n, vertex.out) <= 0) vertex.n = hit.ng;
            // Both normals agree on the side that a direction is on.
            const auto is_allowed = [&](const Vec& in) {
                return glm::dot(in, hit.ng) * glm::dot(in, vertex.n) > 0;
            };

            // Light without size: `irradiance` across the ray, at the wavelength of its argument,
            // from the direction `in`, which is free where nothing stands within `distance`.
            const auto add_delta = [&](const Vec& in, double distance, const Vec& zero,
                                       const LightPolarisation& polarisation,
                                       const auto& irradiance) {
                if (!is_allowed(in)) return;
                const Vec in_frame = any_perpendicular(in);
                const std::optional<Matrix> way =
                    free_way(hit.p, in, distance, hit.primitive, in_frame, rays);
                if (!way) return;
                const Stokes<double> stokes =
                    emitted_stokes(polarisation, zero, -in, in_frame, handedness_);
                for (size_t i = 0; i < nm.size(); ++i) {
                    const Matrix m = surfaces_.scatter(material, nm[i], vertex, in, in_frame);
                    add(i, product[i] * m * *way, irradiance(nm[i]), stokes);
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

            const auto step = surfaces_.choose(material, nm, vertex, random);
            if (!step || !is_allowed(step->in)) return sum;
            for (size_t i = 0; i < nm.size(); ++i) product[i] = product[i] * step->worth[i];
            o = hit.p;
            d = step->in;
            frame = step->in_frame;
            from = hit.primitive;
        }
    }

    // What light meets on its way along -in to p from `distance`: optical elements, as one matrix
    // in the frame of x axis `frame`. Nothing where a surface blocks it.
    std::optional<Matrix> free_way(Vec p, const Vec& in, double distance, int from,
                                   const Vec& frame, uint64_t* rays) const {
        Matrix way = Matrix::identity();
        for (int i = 0; i < most_straight; ++i) {
            ReferenceHit hit;
            ++*rays;
            if (!geometry_.intersect(p, in, from, &hit) || hit.t >= distance) return way;
            const Shape& shape = scene_.shapes[hit.shape];
            if (!surfaces_.is_element(shape.material)) return {};
            way = way * surfaces_.element(shape.material, Vec(shape.world_from_object[0]), hit.ng,
                                          -in, frame);
            distance -= hit.t;
            p = hit.p;
            from = hit.primitive;
        }
        return {};
    }

    // Surfaces in a row that rays go straight through; more are a ray along one of them.
    static constexpr int most_straight = 10000;

    const Scene& scene_;
    ReferenceGeometry geometry_;
    ReferenceCamera camera_;
    double handedness_;
    ReferenceSurfaces surfaces_;
    std::vector<ReferenceSky> skies_;
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
            ReferenceRandom random(options.seed, pixel, static_cast<uint64_t>(sample));
            const double dx = (2 * random() - 1) * scene.filter.radius_x;
            const double dy = (2 * random() - 1) * scene.filter.radius_y;
            for (size_t b = 0; b < bands; ++b) {
                const auto& band = options.bands_nm[b];
                nm[b] = band[static_cast<size_t>(random() * static_cast<double>(band.size()))];
            }
            const auto width = static_cast<size_t>(result.width);
            const size_t column = pixel % width, row = pixel / width;
            const auto stokes =
                tracer.trace(static_cast<double>(column) + 0.5 + dx,
                             static_cast<double>(row) + 0.5 + dy, nm, random, &own_rays);
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
