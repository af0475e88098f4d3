// How much dearer a whole render is than the ray queries in it.
//
//   ray_replay [--beta B] [--environment FILE|courtyard] [--size PIXELS] [--spp N] [--pairs N]
//              [--transport auto|scalar|intensity|stokes] [--rays needed|every]
//
// A copper half-sphere (analytic, cut at its rim) in a lat-long environment, one thread, 8
// wavelengths a path, stored variance on. The linker sends the renderer's rtcIntersect1 and
// rtcOccluded1 through this file (--wrap), where one render's queries are written to memory in the
// order in which they are made, tile by tile; the renderer itself knows nothing of it. Then renders
// (queries passed through) and replays of those queries against the same scene alternate. Printed
// are the medians of the pairs' ratio and times, Embree's Mrays/s in the replay, and that of the
// same rays against a bare user-geometry sphere in float, cut at the same height, in a scene of its
// own. The same once more by the processor's clock, which other programs on the machine disturb
// less; there the rendering loop is the whole call less one with a single sample. Rays that are
// known to meet nothing are traced with --rays every only.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/error.h"
#include "render/embree.h"
#include "render/environment_choice.h"
#include "render/geometry.h"
#include "render/render.h"
#include "render/transport_choice.h"

namespace {

struct Query {
    float origin[3], far;
    float direction[3];
    bool occlusion;
};

std::vector<Query>* recording = nullptr;  // null: queries are passed through only
RTCScene last_scene = nullptr;

void record(const RTCRay& ray, bool occlusion) {
    recording->push_back({{ray.org_x, ray.org_y, ray.org_z},
                          ray.tfar,
                          {ray.dir_x, ray.dir_y, ray.dir_z},
                          occlusion});
}

}  // namespace

#if RTC_VERSION_MAJOR >= 4
using Arguments3 = RTCIntersectArguments;
using ArgumentsO = RTCOccludedArguments;
#else
using Arguments3 = RTCIntersectContext;
using ArgumentsO = RTCIntersectContext;
#endif

// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming)
// The linker's --wrap: callers of rtcIntersect1 arrive at __wrap_, __real_ is Embree's.
extern "C" {
void __real_rtcIntersect1(RTCScene scene, Arguments3* arguments, RTCRayHit* ray_hit);
void __real_rtcOccluded1(RTCScene scene, ArgumentsO* arguments, RTCRay* ray);
void __wrap_rtcIntersect1(RTCScene scene, Arguments3* arguments, RTCRayHit* ray_hit);
void __wrap_rtcOccluded1(RTCScene scene, ArgumentsO* arguments, RTCRay* ray);

void __wrap_rtcIntersect1(RTCScene scene, Arguments3* arguments, RTCRayHit* ray_hit) {
    last_scene = scene;
    if (recording) record(ray_hit->ray, false);
    __real_rtcIntersect1(scene, arguments, ray_hit);
}

void __wrap_rtcOccluded1(RTCScene scene, ArgumentsO* arguments, RTCRay* ray) {
    if (recording) record(*ray, true);
    __real_rtcOccluded1(scene, arguments, ray);
}
}
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)

namespace drude {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const size_t n = values.size();
    return n % 2 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

// Of this process, all threads.
double processor_seconds() {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

struct Replay {
    double seconds = 0, processor_seconds = 0;
    size_t hits = 0;
};

// Calls Embree itself, not the wrappers above.
Replay replay(RTCScene scene, const std::vector<Query>& queries) {
    Replay result;
    const auto start = Clock::now();
    const double processor_start = processor_seconds();
#if RTC_VERSION_MAJOR >= 4
    Arguments3* const arguments = nullptr;
    ArgumentsO* const occlusion_arguments = nullptr;
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCIntersectContext* const arguments = &context;
    RTCIntersectContext* const occlusion_arguments = &context;
#endif
    alignas(16) RTCRayHit query{};
    for (const Query& q : queries) {
        RTCRay& ray = query.ray;
        ray.org_x = q.origin[0], ray.org_y = q.origin[1], ray.org_z = q.origin[2];
        ray.dir_x = q.direction[0], ray.dir_y = q.direction[1], ray.dir_z = q.direction[2];
        ray.tnear = 0, ray.time = 0, ray.tfar = q.far;
        ray.mask = ~0u, ray.id = 0, ray.flags = 0;
        if (q.occlusion) {
            __real_rtcOccluded1(scene, occlusion_arguments, &ray);
            result.hits += ray.tfar < 0;
        } else {
            query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
            query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
            __real_rtcIntersect1(scene, arguments, &query);
            result.hits += query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
        }
    }
    result.seconds = seconds_since(start);
    result.processor_seconds = processor_seconds() - processor_start;
    return result;
}

// The upper half of the unit sphere around the origin, as little work as a user geometry can be.
class BareSphere {
  public:
    BareSphere() : device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
        const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER);
        rtcSetGeometryUserPrimitiveCount(geometry, 1);
        rtcSetGeometryBoundsFunction(geometry, bounds, nullptr);
        rtcSetGeometryIntersectFunction(geometry, intersect);
        rtcSetGeometryOccludedFunction(geometry, occluded);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_, geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(scene_);
    }
    ~BareSphere() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }
    BareSphere(const BareSphere&) = delete;
    BareSphere& operator=(const BareSphere&) = delete;
    RTCScene scene() const { return scene_; }

  private:
    static void bounds(const RTCBoundsFunctionArguments* a) {
        *a->bounds_o = {-1, -1, 0, 0, 1, 1, 1, 0};
    }
    // The nearest distance in (tnear, tfar) at which the ray meets it, or -1.
    static float distance(const RTCRay& r) {
        const float b = -(r.org_x * r.dir_x + r.org_y * r.dir_y + r.org_z * r.dir_z);
        const float px = r.org_x + b * r.dir_x, py = r.org_y + b * r.dir_y;
        const float pz = r.org_z + b * r.dir_z;
        const float gap = 1 - (px * px + py * py + pz * pz);
        if (gap < 0) return -1;
        const float half = std::sqrt(gap);
        for (const float t : {b - half, b + half}) {
            if (t > r.tnear && t < r.tfar && r.org_z + t * r.dir_z >= 0) return t;
        }
        return -1;
    }
    static void intersect(const RTCIntersectFunctionNArguments* a) {
        if (!a->valid[0]) return;
        auto* query = reinterpret_cast<RTCRayHit*>(a->rayhit);
        const float t = distance(query->ray);
        if (!(t > 0)) return;
        query->ray.tfar = t;
        query->hit.geomID = a->geomID;
        query->hit.primID = a->primID;
    }
    static void occluded(const RTCOccludedFunctionNArguments* a) {
        if (!a->valid[0]) return;
        auto* ray = reinterpret_cast<RTCRay*>(a->ray);
        if (distance(*ray) > 0) ray->tfar = -std::numeric_limits<float>::infinity();
    }

    RTCDevice device_;
    RTCScene scene_;
};

struct Options {
    double beta = 0;
    std::string environment = "courtyard", transport = "auto", rays = "needed";
    int size = 512, samples = 64, pairs = 11;
};

Options parse(int argc, char** argv) {
    Options options;
    for (int i = 1; i < argc; i += 2) {
        const std::string name = argv[i];
        if (i + 1 == argc) user_error("ray_replay: {} wants a value", name);
        const std::string value = argv[i + 1];
        const auto positive = [&] {
            const int number = std::atoi(value.c_str());
            if (number < 1) user_error("ray_replay: {} {}: expected 1 or more", name, value);
            return number;
        };
        if (name == "--beta") {
            options.beta = std::atof(value.c_str());
        } else if (name == "--environment") {
            options.environment = value;
        } else if (name == "--transport") {
            options.transport = value;
        } else if (name == "--rays") {
            if (value != "needed" && value != "every") {
                user_error("ray_replay: --rays {}: expected 'needed' or 'every'", value);
            }
            options.rays = value;
        } else if (name == "--size") {
            options.size = positive();
        } else if (name == "--spp") {
            options.samples = positive();
        } else if (name == "--pairs") {
            options.pairs = positive();
        } else {
            user_error(
                "ray_replay: no option '{}'; there are --beta, --environment, --transport, --rays, "
                "--size, --spp and --pairs",
                name);
        }
    }
    return options;
}

// scenes/half-sphere.pbrt with another roughness.
Scene half_sphere(const Options& options) {
    const std::string text = fmt::format(
        "LookAt 0 -3.4 0.3  0 0 0.42  0 0 1\n"
        "Camera \"perspective\" \"float fov\" 40\n"
        "Film \"rgb\" \"integer xresolution\" {0} \"integer yresolution\" {0}\n"
        "PixelFilter \"box\"\nIntegrator \"path\" \"integer maxdepth\" 10\n"
        "WorldBegin\nLightSource \"infinite\" \"rgb L\" [ 1 1 1 ]\n"
        "Material \"conductor\" \"string material\" \"Cu\" \"string lobe\" \"trowbridge-reitz\"\n"
        "  \"string masking\" \"smith\" \"float beta\" {1}\n"
        "Shape \"sphere\" \"float radius\" 1 \"float zmin\" 0\n",
        options.size, options.beta);
    Scene scene = parse_scene(text, "ray_replay.pbrt");
    replace_environment(&scene, options.environment, 1);
    return scene;
}

void run(const Options& options) {
    const Scene scene = half_sphere(options);
    RenderOptions render_options;
    render_options.samples_per_pixel = options.samples;
    render_options.wavelengths = 8;
    render_options.threads = 1;
    render_options.quiet = true;
    render_options.trace_every_ray = options.rays == "every";
    if (options.transport == "scalar") render_options.transport = Transport::scalar;
    if (options.transport == "intensity") render_options.transport = Transport::intensity;
    if (options.transport == "stokes") {
        render_options.transport = Transport::stokes;
        render_options.stokes = true;
    }

    std::vector<Query> queries;
    queries.reserve(static_cast<size_t>(options.size) * options.size * options.samples * 3);
    recording = &queries;
    const RenderResult recorded = render(scene, render_options);
    recording = nullptr;

    // A scene that stays, and its handle.
    const Geometry geometry(scene);
    Hit hit;
    geometry.intersect({0, 0, 5}, {0, 0, -1}, &hit);
    const RTCScene embree = last_scene;
    const BareSphere bare;

    const size_t hits = replay(embree, queries).hits;
    const auto occlusions =
        std::count_if(queries.begin(), queries.end(), [](const Query& q) { return q.occlusion; });
    fmt::print("beta {}, {} x {} x {}, {}, transport {} ({}), Embree {} {}\n", options.beta,
               options.size, options.size, recorded.samples_per_pixel, options.environment,
               transport_name(recorded.transport), recorded.transport_reason, RTC_VERSION_STRING,
               geometry.isa());
    const double pixels = static_cast<double>(options.size) * options.size;
    fmt::print("{} queries ({:.2f} a sample), {} of them of occlusion, {} hits\n", queries.size(),
               static_cast<double>(queries.size()) / (pixels * recorded.samples_per_pixel),
               occlusions, hits);
    if (queries.size() < recorded.rays) {
        user_error("{} rays were counted and {} queries recorded: the linker's --wrap is missing",
                   recorded.rays, queries.size());
    }

    RenderOptions one_sample = render_options;
    one_sample.samples_per_pixel = 1;
    double preparation = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) {
        const double start = processor_seconds();
        render(scene, one_sample);
        preparation = std::min(preparation, processor_seconds() - start);
    }

    std::vector<double> ratio, whole, embree_alone, of_bare;
    std::vector<double> processor_ratio, processor_whole, processor_replay;
    for (int pair = 0; pair < options.pairs; ++pair) {
        const double start = processor_seconds();
        whole.push_back(render(scene, render_options).render_seconds);
        processor_whole.push_back(processor_seconds() - start - preparation);
        const Replay again = replay(embree, queries);
        if (again.hits != hits) user_error("the replay gave {} hits, not {}", again.hits, hits);
        embree_alone.push_back(again.seconds);
        ratio.push_back(whole.back() / again.seconds);
        processor_replay.push_back(again.processor_seconds);
        processor_ratio.push_back(processor_whole.back() / again.processor_seconds);
        of_bare.push_back(replay(bare.scene(), queries).processor_seconds);
    }
    const double million = static_cast<double>(queries.size()) * 1e-6;
    fmt::print("render {:.2f} s, replay {:.2f} s, ratio {:.2f} ({:.2f} to {:.2f})\n", median(whole),
               median(embree_alone), median(ratio), *std::min_element(ratio.begin(), ratio.end()),
               *std::max_element(ratio.begin(), ratio.end()));
    fmt::print("by the processor's clock {:.2f} s, {:.2f} s, ratio {:.2f} ({:.2f} to {:.2f})\n",
               median(processor_whole), median(processor_replay), median(processor_ratio),
               *std::min_element(processor_ratio.begin(), processor_ratio.end()),
               *std::max_element(processor_ratio.begin(), processor_ratio.end()));
    fmt::print("there replay {:.1f} Mrays/s, bare sphere {:.1f} Mrays/s; medians of {} pairs\n",
               million / median(processor_replay), million / median(of_bare), options.pairs);
}

}  // namespace
}  // namespace drude

int main(int argc, char** argv) {
    try {
        drude::run(drude::parse(argc, argv));
        return 0;
    } catch (const drude::Error& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 2;
    }
}
