#include "fitter/lobe_scan_model.h"

#include <Eigen/Core>
#include <cmath>
#include <map>

#include "materials/microfacet.h"
#include "materials/surface.h"

namespace drude {

namespace {

using Direction = Vec3<double>;

// What one direction inside the cone contributes, D and the reflectances left out.
struct Node {
    double tan2 = 0, factor = 0, cos_facet = 1, sin2_planes = 0;
};

// A direction in the plane of incidence (x, z), `angle` from the normal towards +x.
Direction in_plane(double angle) {
    return {std::sin(angle), 0, std::cos(angle)};
}

Node make_node(const Direction& i, const Direction& o, const Microfacets<double>& masking,
               double weight) {
    Node node;
    if (!(o.z > 0)) return node;
    const Direction m = glm::normalize(i + o);
    node.tan2 = (m.x * m.x + m.y * m.y) / (m.z * m.z);
    // BRDF times cos of the outgoing direction, without D.
    node.factor = weight * masking.G2(o, i, m) / (4 * i.z);
    node.cos_facet = std::min(glm::dot(i, m), 1.0);
    // Between y, which is s of the surface, and s of the facet.
    const Direction s = glm::cross(i, m);
    const double size2 = glm::dot(s, s);
    node.sin2_planes = size2 > 1e-24 ? 1 - s.y * s.y / size2 : 0;
    return node;
}

// Directions of equal share of the cone's solid angle around `axis`.
std::vector<Node> cone_nodes(const Direction& i, double axis_angle, double half_angle,
                             const Microfacets<double>& masking) {
    const Direction axis = in_plane(axis_angle);
    const Direction along(std::cos(axis_angle), 0, -std::sin(axis_angle)), across(0, 1, 0);
    std::vector<Node> nodes;
    for (size_t ring = 0; ring < LobeScanModel::rings; ++ring) {
        // Equal shares in the cosine, which is uniform in solid angle.
        const double share = (static_cast<double>(ring) + 0.5) / LobeScanModel::rings;
        const double fall = share * 2 * std::pow(std::sin(half_angle / 2), 2);  // 1 - cos
        const double sine = std::sqrt(fall * (2 - fall));
        const bool in_plane_spokes = ring % 2 == 0;
        for (size_t spoke = 0; spoke < LobeScanModel::spokes / 2 + (in_plane_spokes ? 1 : 0);
             ++spoke) {
            const double phi = 2 * pi * (static_cast<double>(spoke) + (in_plane_spokes ? 0 : 0.5)) /
                               LobeScanModel::spokes;
            const bool alone =
                in_plane_spokes && (spoke == 0 || spoke == LobeScanModel::spokes / 2);
            const Direction o =
                (1 - fall) * axis + sine * (std::cos(phi) * along + std::sin(phi) * across);
            constexpr double share_of_all = 1.0 / (LobeScanModel::rings * LobeScanModel::spokes);
            nodes.push_back(make_node(i, o, masking, alone ? share_of_all : 2 * share_of_all));
        }
    }
    return nodes;
}

}  // namespace

LobeScanModel::LobeScanModel(const LobeScan& scan, const Material& metal) {
    // Of V-grooves the masking knows no beta; any lobe will do.
    const Microfacets<double> masking(Lobe::beckmann, Masking::v_groove, 0.1);
    std::map<std::pair<double, double>, size_t> positions;
    std::map<double, size_t> wavelengths;
    std::vector<Node> nodes_of_all;
    for (const LobeScanRow& row : scan.rows) {
        const auto [position, is_new] =
            positions.insert({{row.angle_deg, row.offset_deg}, nodes_of_all.size()});
        if (is_new) {
            const std::vector<Node> cone = cone_nodes(
                in_plane(-row.angle_deg * degree), (row.angle_deg + row.offset_deg) * degree,
                scan.detector_half_angle_deg * degree, masking);
            nodes_of_all.insert(nodes_of_all.end(), cone.begin(), cone.end());
        }
        const size_t first = position->second;
        const size_t number =
            wavelengths.insert({row.wavelength_nm, wavelengths.size()}).first->second;
        std::vector<double> weights_p;
        for (size_t j = first; j < first + nodes; ++j) {
            const Node& node = nodes_of_all[j];
            const Reflection<double> r = reflect(metal, row.wavelength_nm, node.cos_facet);
            const double factor = node.factor * scan.detector_solid_angle_sr;
            const double across = node.sin2_planes, along = 1 - across;
            weights_.push_back(factor * (r.Rs * along + r.Rp * across));
            weights_p.push_back(factor * (r.Rp * along + r.Rs * across));
        }
        weights_.insert(weights_.end(), weights_p.begin(), weights_p.end());
        first_node_.insert(first_node_.end(), 2, first);
        data_.push_back({row.reflectance_s, row.sigma_s, number});
        data_.push_back({row.reflectance_p, row.sigma_p, number});
    }
    for (const Node& node : nodes_of_all) tan2_.push_back(node.tan2);
    wavelengths_ = wavelengths.size();
}

std::vector<double> LobeScanModel::average(const std::vector<double>& at_facets) const {
    using Nodes = Eigen::Map<const Eigen::Matrix<double, static_cast<int>(nodes), 1>>;
    std::vector<double> values;
    values.reserve(data_.size());
    for (size_t i = 0; i < data_.size(); ++i) {
        values.push_back(Nodes(&weights_[i * nodes]).dot(Nodes(&at_facets[first_node_[i]])));
    }
    return values;
}

}  // namespace drude
