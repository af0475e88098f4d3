// The body of BatchTracer for one transport and one packet width; included by the source files
// that instantiate it, one a transport, so that they compile side by side.
#pragma once

#include "render/batch_tracer.h"

namespace drude {

template <Transport transport, int N>
class PacketBatchTracer final : public BatchTracer {
  public:
    explicit PacketBatchTracer(const TracerSetup& setup)
        : setup_(setup),
          tables_(setup.scene, setup.numbers, setup.surfaces, setup.threads, *setup.observer),
          path_{setup.scene,
                setup.geometry,
                setup.lights,
                setup.elements,
                setup.numbers,
                tables_,
                setup.camera.handedness(),
                setup.max_depth,
                setup.strategy,
                setup.clear_after,
                before_the_camera(setup.scene.camera)} {}

    void trace(const BatchRequest& request, BatchResult* result,
               PathStatistics* statistics) const override {
        constexpr int rows = carried_rows<transport>;
        // Tristimulus sums a lane; the lanes are added up once, at the end of the batch.
        Packet<N> xyz[rows][3];
        for (auto& row : xyz) {
            for (Packet<N>& sum : row) sum = Packet<N>(0.0f);
        }
        Packet<N> spectral[rows];
        for (Packet<N>& sum : spectral) sum = Packet<N>(0.0f);

        for (int index = 0; index < request.batch_size; ++index) {
            Sampler sampler(setup_.seed, static_cast<uint32_t>(request.x),
                            static_cast<uint32_t>(request.y), request.batch,
                            static_cast<uint32_t>(index),
                            static_cast<uint32_t>(request.batch_size));
            const glm::vec2 u = sampler.next_2d();
            float weight_x = 1, weight_y = 1;
            const float dx = setup_.filter.offset_x(u.x, &weight_x);
            const float dy = setup_.filter.offset_y(u.y, &weight_y);
            const double x_film = request.x + 0.5 + static_cast<double>(dx);
            const double y_film = request.y + 0.5 + static_cast<double>(dy);
            const CameraRay ray = setup_.camera.has_lens()
                                      ? setup_.camera(x_film, y_film, sampler.next_2d())
                                      : setup_.camera(x_film, y_film);
            const int phase = Wavelengths<N>::phase(sampler.next_1d());
            Path<transport, N> path(path_, phase, sampler, *statistics);
            const Contribution<transport, N>& radiance = path.trace(ray);
            const Packet<N> x = tables_.x[phase], y = tables_.y[phase], z = tables_.z[phase];
            for (int i = 0; i < rows; ++i) {
                const Packet<N> s = radiance.s[i] * Packet<N>(weight_x * weight_y);
                xyz[i][0] += s * x;
                xyz[i][1] += s * y;
                xyz[i][2] += s * z;
                if constexpr (N == spectral_bins) spectral[i] += s;
            }
        }

        // Each lane stands for `spacing` nanometres.
        const double scale = static_cast<double>(Wavelengths<N>::spacing) / request.batch_size;
        const auto& to_rgb = rgb_from_xyz();
        for (int i = 0; i < rows; ++i) {
            double sums[3];
            for (int c = 0; c < 3; ++c) sums[c] = static_cast<double>(sum(xyz[i][c])) * scale;
            for (int c = 0; c < 3; ++c) {
                result->rgb[i][c] =
                    to_rgb[c][0] * sums[0] + to_rgb[c][1] * sums[1] + to_rgb[c][2] * sums[2];
            }
            if constexpr (N == spectral_bins) {
                for (int b = 0; b < N; ++b) {
                    result->spectral[i][b] =
                        spectral[i][b] / static_cast<float>(request.batch_size);
                }
            }
        }
    }

    std::vector<std::string> warnings() const override { return tables_.warnings(); }

  private:
    static Throughput<transport, N> before_the_camera(const Camera& camera) {
        if (!camera.analyser) return {};
        const Mueller<double> analyser = mueller(*camera.analyser);
        Mueller<float> m;
        for (int i = 0; i < 4; ++i) {
            for (int j = 0; j < 4; ++j) m.m[i][j] = static_cast<float>(analyser.m[i][j]);
        }
        return Throughput<transport, N>(m);
    }

    TracerSetup setup_;
    SpectralTables<N> tables_;
    PathSetup<transport, N> path_;
};

template <Transport transport>
std::unique_ptr<BatchTracer> make_packet_tracer(int wavelengths, const TracerSetup& setup) {
    switch (wavelengths) {
        case 4:
            return std::make_unique<PacketBatchTracer<transport, 4>>(setup);
        case 8:
            return std::make_unique<PacketBatchTracer<transport, 8>>(setup);
        case 16:
            return std::make_unique<PacketBatchTracer<transport, 16>>(setup);
        default:
            return std::make_unique<PacketBatchTracer<transport, spectral_bins>>(setup);
    }
}

}  // namespace drude
