#include "bench/charts/shadowed_lobe.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "materials/quadrature.h"

namespace drude {

namespace {

constexpr int panels = 48, azimuths = 128, smith_nodes = 1024;

// Middles of even steps over half a turn.
struct Azimuths {
    std::array<double, azimuths> cosine, sine;
    Azimuths() {
        for (size_t k = 0; k < azimuths; ++k) {
            const double phi = pi * (static_cast<double>(k) + 0.5) / azimuths;
            cosine[k] = std::cos(phi);
            sine[k] = std::sin(phi);
        }
    }
};

// The integral of max(0, w.m) over the azimuth of m, over 2 pi.
double projected(double cos_w, double sin_w, double cos_m, double sin_m) {
    const double a = cos_w * cos_m, b = sin_w * sin_m;
    if (a >= b) return a;
    const double turn = std::acos(-a / b);
    return (a * turn + b * std::sin(turn)) / pi;
}

}  // namespace

double beta_at_half_height(Lobe lobe, double half_height) {
    if (lobe != Lobe::beckmann) return half_height;
    const double t = std::tan(half_height);
    return t / std::sqrt(std::log(2.0) + 2 * std::log1p(t * t));
}

ShadowedLobe::ShadowedLobe(Lobe lobe, Masking masking, double beta)
    : masking_(masking), beta_(beta), scale_(std::tan(std::min(beta, 1.2))) {
    const LobeDensity<double> D(lobe, beta);
    // tan = scale s/(1 - s): as many nodes within the lobe as in its tail, up to the horizon.
    const QuadratureRule rule = gauss_legendre(5);
    for (int panel = 0; panel < panels; ++panel) {
        for (size_t j = 0; j < rule.x.size(); ++j) {
            const double s = (panel + 0.5 + 0.5 * rule.x[j]) / panels;
            const double tangent = scale_ * s / (1 - s);
            const double cosine = 1 / std::sqrt(1 + tangent * tangent);
            const double sine = tangent * cosine;
            // d(angle) = cos^2 d(tan)
            const double step = cosine * cosine * scale_ / ((1 - s) * (1 - s));
            nodes_.push_back(
                {cosine, sine,
                 2 * pi * D(tangent * tangent) * sine * step * 0.5 * rule.weight[j] / panels});
        }
    }
    for (int k = 1; k <= smith_nodes; ++k) {
        const double s = static_cast<double>(k) / smith_nodes;
        const double cotangent = k < smith_nodes ? scale_ * s / (1 - s) : 1e9;
        const double sin_w = 1 / std::sqrt(1 + cotangent * cotangent), cos_w = cotangent * sin_w;
        double area = 0;
        for (const Node& m : nodes_) {
            area += m.weight * projected(cos_w, sin_w, m.cosine, m.sine);
        }
        smith_.push_back(std::min(1.0, cos_w / area));
    }
}

double ShadowedLobe::smith_G1(double cos_theta) const {
    if (!(cos_theta > 0)) return 0;
    // Along the horizon G1 goes to 0 as its cosine; s = 0 is left out of the table.
    const double sine = std::sqrt(std::max(0.0, (1 - cos_theta) * (1 + cos_theta)));
    const double s = cos_theta / (cos_theta + scale_ * sine);
    const double place = s * smith_nodes - 1;
    if (place <= 0) return smith_.front() * (place + 1);
    const auto below = std::min(static_cast<size_t>(place), smith_.size() - 2);
    const double t = place - static_cast<double>(below);
    return smith_[below] + t * (smith_[below + 1] - smith_[below]);
}

double ShadowedLobe::G2(const Vec3<double>& o, const Vec3<double>& i, const Vec3<double>& m) const {
    const double om = glm::dot(o, m), im = glm::dot(i, m);
    if (!(om > 0) || !(im > 0) || !(o.z > 0) || !(i.z > 0)) return 0;
    if (masking_ == Masking::v_groove) {
        return std::min(1.0, 2 * m.z * std::min(o.z / om, i.z / im));
    }
    return 1 / (1 / smith_G1(o.z) + 1 / smith_G1(i.z) - 1);
}

double ShadowedLobe::norm() const {
    double sum = 0;
    for (const Node& m : nodes_) sum += m.weight * m.cosine;
    return sum;
}

// BRDF times cos i is D G2 / (4 o.z), and a solid angle of i is 4 o.m times one of m.
template <class F>
void ShadowedLobe::each_facet(double cos_theta, const F& f) const {
    const Vec3<double> o(std::sqrt(std::max(0.0, (1 - cos_theta) * (1 + cos_theta))), 0, cos_theta);
    static const Azimuths turn;
    for (const Node& node : nodes_) {
        // Both halves of the azimuth are alike.
        for (size_t k = 0; k < azimuths; ++k) {
            const Vec3<double> m(node.sine * turn.cosine[k], node.sine * turn.sine[k], node.cosine);
            const double om = glm::dot(o, m);
            if (!(om > 0)) continue;
            const Vec3<double> i = 2 * om * m - o;
            if (!(i.z > 0)) continue;
            f(om, node.weight / azimuths * G2(o, i, m) * om / o.z);
        }
    }
}

double ShadowedLobe::albedo(double cos_theta) const {
    double sum = 0;
    each_facet(cos_theta, [&](double, double weight) { sum += weight; });
    return sum;
}

std::vector<double> ShadowedLobe::facet_cosines(double cos_theta) const {
    std::vector<double> parts(facet_cosine_nodes, 0.0);
    each_facet(cos_theta, [&](double cosine, double weight) {
        const double place = std::min(cosine, 1.0) * (facet_cosine_nodes - 1);
        const auto below = std::min(static_cast<size_t>(place), parts.size() - 2);
        const double t = place - static_cast<double>(below);
        parts[below] += (1 - t) * weight;
        parts[below + 1] += t * weight;
    });
    return parts;
}

}  // namespace drude
