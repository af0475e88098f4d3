#include "device/signal/psi_delta.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "materials/scalar.h"

namespace drude {

namespace {

// L, C without and C with the retarder, and how they move together.
using Triple = std::array<double, 3>;

struct TripleCovariance {
    double m[3][3] = {};

    void add(const Triple& a, const Triple& b, double weight) {
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) m[i][j] += weight * a[i] * b[j];
        }
    }
};

// Two directions in which a scan's coefficients can move, seen in the triple.
struct Directions {
    Triple alpha = {}, beta = {};
    Triple along(double d_alpha, double d_beta) const {
        Triple t;
        for (int i = 0; i < 3; ++i) t[i] = alpha[i] * d_alpha + beta[i] * d_beta;
        return t;
    }
    void add(const Covariance& covariance, double scale, TripleCovariance* sum) const {
        sum->add(alpha, alpha, scale * covariance.aa);
        sum->add(alpha, beta, scale * covariance.ab);
        sum->add(beta, alpha, scale * covariance.ab);
        sum->add(beta, beta, scale * covariance.bb);
    }
};

Triple operator+(const Triple& a, const Triple& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

double square(double x) {
    return x * x;
}

Covariance project(const TripleCovariance& c, const Triple& psi, const Triple& delta) {
    Covariance result;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            result.aa += psi[i] * c.m[i][j] * psi[j];
            result.ab += psi[i] * c.m[i][j] * delta[j];
            result.bb += delta[i] * c.m[i][j] * delta[j];
        }
    }
    return result;
}

// How far Delta moves when cos Delta moves by its own standard deviation, over that: -1 / sin Delta
// but for 0 and 180 degrees, where half of the interval that the noise covers is outside.
double slope_of_delta(double cosine, double sigma) {
    const double c = std::clamp(cosine, -1.0, 1.0);
    const double sine = std::sqrt((1 - c) * (1 + c));
    if (!(sigma > 0)) return -1 / std::max(sine, 1e-9);
    const double below = c - sigma >= -1 ? std::acos(c - sigma) - std::acos(c) : 0;
    const double above = c + sigma <= 1 ? std::acos(c) - std::acos(c + sigma) : 0;
    if (below > 0 && above > 0) return -0.5 * (below + above) / sigma;
    const double either = std::max(below, above);
    return -(either > 0 ? either : pi / 2) / sigma;
}

struct Averages {
    Triple value = {};
    TripleCovariance noise, common;
    int with_retarder = 0, without = 0;
    bool possible = true, faint = false;
};

Averages average(const std::vector<BinScan>& scans, const RetarderState& retarder,
                 const AzimuthErrors& errors) {
    Averages result;
    int darks = 0, stops = 0;
    for (const BinScan& scan : scans) {
        ++(scan.retarder_in ? result.with_retarder : result.without);
        darks = std::max(darks, scan.dark + 1);
        stops = std::max(stops, scan.stop + 1);
    }
    const bool psi_from_both = retarder.known || result.without == 0;
    const double share_l =
        1.0 / (psi_from_both ? result.with_retarder + result.without : result.without);
    std::vector<Triple> dark(darks, Triple{}), stop(stops, Triple{});
    Triple polariser = {}, analyser = {};
    for (const BinScan& scan : scans) {
        const double a = scan.fit.alpha, b = scan.fit.beta;
        if (!(std::abs(a) < 1)) {
            result.possible = false;
            return result;
        }
        const int slot = scan.retarder_in ? 2 : 1;
        const double share_c = 1.0 / (scan.retarder_in ? result.with_retarder : result.without);
        const double weight_l = scan.retarder_in && !psi_from_both ? 0 : share_l;
        const double sigma_a = std::sqrt(scan.fit.noise.aa + square(scan.fit.dark_alpha));
        result.faint = result.faint || 1 - std::abs(a) < 5 * sigma_a;
        const double rest = (1 - a) * (1 + a), root = std::sqrt(rest);
        const double sign = std::tan(scan.analyser_rad) > 0 ? 1 : -1;
        const double t = scan.retarder_in && retarder.known ? retarder.diattenuation : 1;
        result.value[0] +=
            weight_l *
            (std::atanh(a) + std::log(std::abs(std::tan(scan.analyser_rad))) - std::log(t));
        result.value[slot] += share_c * sign * b / root;
        Directions move;
        move.alpha[0] = weight_l / rest;
        move.alpha[slot] = share_c * sign * a * b / (rest * root);
        move.beta[slot] = share_c * sign / root;
        move.add(scan.fit.noise, 1, &result.noise);
        dark[scan.dark] = dark[scan.dark] + move.along(scan.fit.dark_alpha, scan.fit.dark_beta);
        move.add(scan.fit.jitter, square(errors.polariser_stop), &result.common);
        // A polariser that stands further than reported turns (alpha, beta) by twice that.
        polariser = polariser + move.along(-2 * b, 2 * a);
        const Triple turned = {weight_l * 2 / std::sin(2 * scan.analyser_rad), 0, 0};
        analyser = analyser + turned;
        stop[scan.stop] = stop[scan.stop] + turned;
    }
    for (const Triple& d : dark) result.noise.add(d, d, 1);
    for (const Triple& s : stop) result.common.add(s, s, square(errors.analyser_stop));
    result.common.add(polariser, polariser, square(errors.polariser_offset));
    result.common.add(analyser, analyser, square(errors.analyser_offset));
    return result;
}

}  // namespace

PsiDelta combine_scans(const std::vector<BinScan>& scans, const RetarderState& retarder,
                       const AzimuthErrors& errors) {
    PsiDelta result;
    const Averages mean = average(scans, retarder, errors);
    if (!mean.possible) {
        result.state = PsiDeltaState::impossible;
        return result;
    }
    result.faint = mean.faint;
    const double c1 = mean.value[1], c2 = mean.value[2];
    result.psi = std::atan(std::exp(mean.value[0]));
    const Triple psi = {std::sin(2 * result.psi) / 2, 0, 0};
    Triple delta = {};
    if (mean.with_retarder > 0 && retarder.known) {
        const double cosine = std::cos(retarder.retardance_rad);
        const double sine = std::sin(retarder.retardance_rad);
        if (std::abs(sine) < 0.1) {
            result.state = PsiDeltaState::half_wave;
            return result;
        }
        // C2 = cos Delta cos d - sin Delta sin d.
        const double s1 = (c1 * cosine - c2) / sine;
        const double length = c1 * c1 + s1 * s1;
        result.two_cycles = true;
        result.coherence = length;
        result.delta = std::atan2(s1, c1);
        delta[1] = (c1 * cosine / sine - s1) / length;
        delta[2] = -c1 / sine / length;
    } else {
        const double sigma = std::sqrt(mean.noise.m[1][1] + mean.common.m[1][1]);
        if (std::abs(c1) > 1) {
            const bool by_noise = std::abs(c1) - 1 <= 4 * sigma + 1e-12;
            result.state = by_noise ? PsiDeltaState::clamped : PsiDeltaState::impossible;
        }
        result.delta = std::acos(std::clamp(c1, -1.0, 1.0));
        delta[1] = slope_of_delta(c1, sigma);
        // A quarter-wave plate gives C2 = -sin Delta; anything near it the same sign.
        if (mean.with_retarder > 0 && c2 > 0) {
            result.delta = -result.delta;
            delta[1] = -delta[1];
        }
    }
    if (result.delta < 0) result.delta += 2 * pi;
    if (result.delta >= 2 * pi) result.delta = 0;
    result.noise = project(mean.noise, psi, delta);
    result.common = project(mean.common, psi, delta);
    return result;
}

}  // namespace drude
