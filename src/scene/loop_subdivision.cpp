#include "scene/loop_subdivision.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numbers>

#include "base/error.h"

namespace drude {

namespace {

constexpr unsigned none = ~0u;

// Half-edge h = 3 f + i runs from corner i of face f to the next corner.
unsigned next(unsigned h) {
    return h % 3 == 2 ? h - 2 : h + 1;
}
unsigned previous(unsigned h) {
    return h % 3 == 0 ? h + 2 : h - 1;
}

class Surface {
  public:
    Surface(std::vector<glm::dvec3> positions, std::vector<glm::uvec3> faces)
        : Surface(std::move(positions), std::move(faces), {}) {
        join();
        begin_rings();
    }

    void check_vertices() const {
        std::vector<unsigned> faces_at(positions_.size(), 0);
        for (unsigned h = 0; h < half_edges(); ++h) ++faces_at[start(h)];
        std::vector<glm::dvec3> around;
        for (unsigned v = 0; v < positions_.size(); ++v) {
            if (first_[v] == none) continue;
            const bool is_boundary = ring(v, around);
            if (around.size() - (is_boundary ? 1 : 0) != faces_at[v]) {
                user_error(
                    "parts of the surface touch in the single vertex {}; expected its "
                    "triangles side by side around it",
                    v);
            }
        }
    }

    // Two triangles that share all their edges pass as a surface; each one's middle triangle then
    // has the edges of the other's, which the first split is joined anew to find.
    Surface split_and_join() const {
        Surface finer = split();
        return Surface(std::move(finer.positions_), std::move(finer.faces_));
    }

    Surface split() const {
        std::vector<glm::dvec3> points = positions_;
        std::vector<glm::dvec3> around;
        for (unsigned v = 0; v < positions_.size(); ++v) {
            if (first_[v] == none) continue;
            if (ring(v, around)) {
                points[v] = 0.75 * positions_[v] + 0.125 * (around.front() + around.back());
            } else {
                const double b = beta(around.size());
                points[v] =
                    (1 - b * static_cast<double>(around.size())) * positions_[v] + b * sum(around);
            }
        }
        std::vector<unsigned> middle(half_edges());
        for (unsigned h = 0; h < half_edges(); ++h) {
            if (twin_[h] != none && twin_[h] < h) {
                middle[h] = middle[twin_[h]];
                continue;
            }
            const glm::dvec3 ends = positions_[start(h)] + positions_[start(next(h))];
            middle[h] = static_cast<unsigned>(points.size());
            points.push_back(twin_[h] == none
                                 ? 0.5 * ends
                                 : 0.375 * ends + 0.125 * (positions_[start(previous(h))] +
                                                           positions_[start(previous(twin_[h]))]));
        }
        std::vector<glm::uvec3> faces;
        faces.reserve(4 * faces_.size());
        for (unsigned f = 0; f < faces_.size(); ++f) {
            const glm::uvec3 m(middle[3 * f], middle[3 * f + 1], middle[3 * f + 2]);
            faces.push_back(m);
            for (int i = 0; i < 3; ++i) faces.emplace_back(faces_[f][i], m[i], m[(i + 2) % 3]);
        }
        Surface finer(std::move(points), std::move(faces), split_twins());
        finer.begin_rings();
        return finer;
    }

    TriangleMesh limit() const {
        TriangleMesh mesh;
        mesh.triangles = faces_;
        std::vector<glm::dvec3> around;
        Directions directions;
        for (unsigned v = 0; v < positions_.size(); ++v) {
            if (first_[v] == none) {
                mesh.positions.emplace_back(positions_[v]);
                mesh.normals.emplace_back(0, 0, 1);
                continue;
            }
            const bool is_boundary = ring(v, around);
            mesh.positions.emplace_back(is_boundary ? boundary_limit(v, around)
                                                    : inner_limit(v, around));
            mesh.normals.emplace_back(normal(v, around, is_boundary, &directions));
        }
        return mesh;
    }

  private:
    Surface(std::vector<glm::dvec3> positions, std::vector<glm::uvec3> faces,
            std::vector<unsigned> twins)
        : positions_(std::move(positions)), faces_(std::move(faces)), twin_(std::move(twins)) {}

    // The twins after split(), whose face 4 f is the middle of face f and 4 f + 1 + i the part at
    // its corner i: within f, edge j of the middle is edge 1 of the part at corner j + 1. Half-edge
    // i of f is edge 0 of the part at its start and then edge 2 of the part at its end.
    std::vector<unsigned> split_twins() const {
        std::vector<unsigned> twins(4 * twin_.size(), none);
        const auto part = [](unsigned h) { return 3 * (4 * (h / 3) + 1 + h % 3); };
        for (unsigned h = 0; h < half_edges(); ++h) {
            const unsigned middle = 12 * (h / 3) + h % 3, beside = part(next(h)) + 1;
            twins[middle] = beside;
            twins[beside] = middle;
            if (twin_[h] == none) continue;
            twins[part(h)] = part(next(twin_[h])) + 2;
            twins[part(next(h)) + 2] = part(twin_[h]);
        }
        return twins;
    }

    // For a ring of n vertices cosine and sine of 2 pi i / n, kept since nearly all rings are of 6.
    class Directions {
      public:
        const std::vector<glm::dvec2>& of(size_t n) {
            if (n >= known_.size()) known_.resize(n + 1);
            std::vector<glm::dvec2>& all = known_[n];
            for (size_t i = all.size(); i < n; ++i) {
                const double angle =
                    2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
                all.emplace_back(std::cos(angle), std::sin(angle));
            }
            return all;
        }

      private:
        std::vector<std::vector<glm::dvec2>> known_;
    };

    static double beta(size_t valence) {
        return valence == 3 ? 3.0 / 16 : 3 / (8 * static_cast<double>(valence));
    }
    static glm::dvec3 sum(const std::vector<glm::dvec3>& points) {
        glm::dvec3 total(0);
        for (const glm::dvec3& p : points) total += p;
        return total;
    }

    unsigned half_edges() const { return static_cast<unsigned>(3 * faces_.size()); }
    unsigned start(unsigned h) const { return faces_[h / 3][static_cast<int>(h % 3)]; }

    // Finds each half-edge's twin.
    void join() {
        struct Entry {
            unsigned low, high, half_edge;
            bool operator<(const Entry& other) const {
                return low != other.low     ? low < other.low
                       : high != other.high ? high < other.high
                                            : half_edge < other.half_edge;
            }
        };
        std::vector<Entry> entries;
        entries.reserve(half_edges());
        for (unsigned h = 0; h < half_edges(); ++h) {
            const unsigned a = start(h), b = start(next(h));
            entries.push_back({std::min(a, b), std::max(a, b), h});
        }
        std::sort(entries.begin(), entries.end());
        twin_.assign(half_edges(), none);
        for (size_t i = 0; i < entries.size();) {
            size_t end = i + 1;
            while (end < entries.size() && entries[end].low == entries[i].low &&
                   entries[end].high == entries[i].high) {
                ++end;
            }
            if (end - i > 2) {
                user_error("{} triangles share the edge from vertex {} to {}; expected two at most",
                           end - i, entries[i].low, entries[i].high);
            }
            if (end - i == 2) {
                const unsigned h = entries[i].half_edge, other = entries[i + 1].half_edge;
                if (start(h) == start(other)) {
                    user_error(
                        "the two triangles at the edge from vertex {} to {} are wound "
                        "against each other; expected the same way round",
                        entries[i].low, entries[i].high);
                }
                twin_[h] = other;
                twin_[other] = h;
            }
            i = end;
        }
    }

    // Finds for each vertex the half-edge its ring starts with.
    void begin_rings() {
        first_.assign(positions_.size(), none);
        for (unsigned h = 0; h < half_edges(); ++h) {
            // A boundary's ring starts at the boundary.
            if (first_[start(h)] == none || twin_[h] == none) first_[start(h)] = h;
        }
    }

    // The neighbours of a vertex, counter-clockwise; from boundary to boundary where it is on one,
    // which is the answer.
    bool ring(unsigned v, std::vector<glm::dvec3>& around) const {
        around.clear();
        const unsigned first = first_[v];
        unsigned h = first;
        do {
            around.push_back(positions_[start(next(h))]);
            const unsigned back = previous(h);
            h = twin_[back];
            if (h == none) {
                around.push_back(positions_[start(back)]);
                return true;
            }
        } while (h != first);
        return false;
    }

    // The left eigenvector of the subdivision matrix for the eigenvalue 1.
    glm::dvec3 inner_limit(unsigned v, const std::vector<glm::dvec3>& around) const {
        const auto n = static_cast<double>(around.size());
        const double gamma = 1 / (n + 3 / (8 * beta(around.size())));
        return (1 - n * gamma) * positions_[v] + gamma * sum(around);
    }
    // Of a cubic B-spline.
    glm::dvec3 boundary_limit(unsigned v, const std::vector<glm::dvec3>& around) const {
        return (4.0 * positions_[v] + around.front() + around.back()) / 6.0;
    }

    // The tangent across a boundary: the left eigenvector, symmetric about the middle of the ring,
    // of the subdivision matrix for its largest eigenvalue below 1. On the n - 2 inner neighbours
    // it is sin(i theta), theta = pi / (n - 1), with the eigenvalue 3/8 + cos(theta) / 4; the
    // columns of the vertex and of its two neighbours on the boundary then give the other weights.
    glm::dvec3 across_boundary(unsigned v, const std::vector<glm::dvec3>& around) const {
        const size_t n = around.size();
        const glm::dvec3 ends = around.front() + around.back();
        if (n == 2) return ends - 2.0 * positions_[v];  // eigenvalue 1/4
        const double theta = std::numbers::pi / static_cast<double>(n - 1);
        const double eigenvalue = 0.375 + 0.25 * std::cos(theta);
        const double sum_of_sines = 1 / std::tan(theta / 2);
        const double end_weight = (0.375 * sum_of_sines + std::sin(theta) * (eigenvalue - 0.75)) /
                                  (8 * (eigenvalue - 0.5) * (eigenvalue - 0.75) - 1);
        const double own_weight = 8 * end_weight * (eigenvalue - 0.5) - std::sin(theta);
        glm::dvec3 t = own_weight * positions_[v] + end_weight * ends;
        for (size_t i = 1; i + 1 < n; ++i) {
            t += std::sin(static_cast<double>(i) * theta) * around[i];
        }
        return t;
    }

    // Across two tangents, turned to the side that the triangles face. Inside they are the ring
    // times cosine and sine (Loop 1987).
    glm::dvec3 normal(unsigned v, const std::vector<glm::dvec3>& around, bool is_boundary,
                      Directions* directions) const {
        const size_t n = around.size();
        glm::dvec3 s(0), t(0), faces(0);
        for (size_t i = 0; i + (is_boundary ? 1 : 0) < n; ++i) {
            faces += glm::cross(around[i] - positions_[v], around[(i + 1) % n] - positions_[v]);
        }
        if (!is_boundary) {
            const std::vector<glm::dvec2>& to = directions->of(n);
            for (size_t i = 0; i < n; ++i) {
                s += to[i].x * around[i];
                t += to[i].y * around[i];
            }
        } else {
            s = around.back() - around.front();
            t = across_boundary(v, around);
        }
        const glm::dvec3 across = glm::cross(s, t);
        const double length = glm::length(across);
        const double scale = glm::length(s) * glm::length(t);
        if (!(length > 1e-9 * scale)) {
            const double size = glm::length(faces);
            return size > 0 ? faces / size : glm::dvec3(0, 0, 1);
        }
        return (glm::dot(across, faces) < 0 ? -1.0 : 1.0) / length * across;
    }

    std::vector<glm::dvec3> positions_;
    std::vector<glm::uvec3> faces_;
    std::vector<unsigned> twin_, first_;
};

}  // namespace

TriangleMesh subdivide_loop(const std::vector<glm::dvec3>& positions,
                            const std::vector<glm::uvec3>& triangles, int levels) {
    size_t count = triangles.size();
    for (int level = 0; level < levels; ++level) {
        count *= 4;
        if (count > most_subdivided_triangles) {
            user_error("{} levels of {} triangles come to more than {}; expected fewer levels",
                       levels, triangles.size(), most_subdivided_triangles);
        }
    }
    for (const glm::uvec3& face : triangles) {
        if (face.x == face.y || face.y == face.z || face.z == face.x) {
            user_error("a triangle has the vertices {}, {}, {}; expected three different ones",
                       face.x, face.y, face.z);
        }
    }
    Surface surface(positions, triangles);
    surface.check_vertices();
    for (int level = 0; level < levels; ++level) {
        surface = level == 0 ? surface.split_and_join() : surface.split();
    }
    return surface.limit();
}

}  // namespace drude
