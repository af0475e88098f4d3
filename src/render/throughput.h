// What a path multiplies up, as rich as the picture asks for: one number a wavelength (scalar), the
// first row of the Mueller product (intensity) or all of it (stokes).
//
// Columns belong to the frame of the ray that the path is about to follow backwards: `x` is that
// frame's x axis. Rows belong to the camera. Reflections have four distinct numbers and rotations
// touch two columns, so that no dense product ever happens.
#pragma once

#include <glm/vec3.hpp>

#include "materials/mueller.h"
#include "materials/packet.h"

namespace drude {

enum class Transport { scalar, intensity, stokes };

// Rows of the Mueller product that are carried; scalar carries its corner alone.
template <Transport transport>
inline constexpr int carried_rows = transport == Transport::stokes ? 4 : 1;
template <Transport transport>
inline constexpr int carried_columns = transport == Transport::scalar ? 1 : 4;

// Stokes components, a packet of wavelengths each, that reach the camera.
template <Transport transport, int N>
struct Contribution {
    Packet<N> s[carried_rows<transport>];
};

template <Transport transport, int N>
class Throughput {
  public:
    static constexpr int rows = carried_rows<transport>;
    static constexpr int columns = carried_columns<transport>;

    Throughput() {
        for (int i = 0; i < rows; ++i) {
            for (int j = 0; j < columns; ++j) m_[i][j] = Packet<N>(i == j ? 1.0f : 0.0f);
        }
    }

    // What stands between the camera and all it sees, in the frame of the pixel: an analyser.
    // Scalar keeps its corner.
    explicit Throughput(const Mueller<float>& first) {
        for (int i = 0; i < rows; ++i) {
            for (int j = 0; j < columns; ++j) m_[i][j] = Packet<N>(first.m[i][j]);
        }
    }

    const Packet<N>& corner() const { return m_[0][0]; }

    void scale(float factor) {
        for (auto& row : m_) {
            for (Packet<N>& element : row) element *= Packet<N>(factor);
        }
    }

    void scale(const Packet<N>& factor) {
        for (auto& row : m_) {
            for (Packet<N>& element : row) element *= factor;
        }
    }

    // An element that leaves the frame as it is. E is a float or a packet.
    template <class E>
    void apply(const Mueller<E>& element) {
        for (auto& m : m_) {
            Packet<N> product[columns];
            for (int j = 0; j < columns; ++j) {
                product[j] = m[0] * Packet<N>(element.m[0][j]);
                for (int k = 1; k < columns; ++k) product[j] += m[k] * Packet<N>(element.m[k][j]);
            }
            for (int j = 0; j < columns; ++j) m[j] = product[j];
        }
    }

    // A reflection or a refraction whose s axis is turned by `out` from this frame's x axis, on the
    // outgoing ray. Afterwards the columns belong to the incoming ray with x axis s.
    void reflect(const Rotation<float>& out, const Reflection<Packet<N>>& r, float factor) {
        const Packet<N> f(factor);
        const Packet<N> A = f * r.A();
        if constexpr (transport == Transport::scalar) {
            m_[0][0] *= A;
        } else {
            const Packet<N> B = f * r.B(), C = f * r.C, S = f * r.S;
            const Packet<N> c(out.cos2), s(out.sin2);
            for (auto& m : m_) {
                // Times the rotation from the s frame back to this one, then times the reflection.
                const Packet<N> m1 = c * m[1] + s * m[2], m2 = c * m[2] - s * m[1];
                const Packet<N> m0 = m[0], m3 = m[3];
                m[0] = m0 * A + m1 * B;
                m[1] = m0 * B + m1 * A;
                m[2] = m2 * C + m3 * S;
                m[3] = m3 * C - m2 * S;
            }
        }
    }

    // What unpolarised light brings to the camera over the same reflection: A and B are all that
    // matters before an unpolarised source.
    Contribution<transport, N> reflect_unpolarised(const Rotation<float>& out, const Packet<N>& A,
                                                   const Packet<N>& B) const {
        Contribution<transport, N> result;
        for (int i = 0; i < rows; ++i) {
            result.s[i] = m_[i][0] * A;
            if constexpr (transport != Transport::scalar) {
                const Packet<N> m1 =
                    Packet<N>(out.cos2) * m_[i][1] + Packet<N>(out.sin2) * m_[i][2];
                result.s[i] += m1 * B;
            }
        }
        return result;
    }

    // A perfect depolariser of the given reflectance: one column is left.
    void depolarise(const Packet<N>& reflectance) {
        for (auto& m : m_) {
            m[0] *= reflectance;
            for (int j = 1; j < columns; ++j) m[j] = Packet<N>(0.0f);
        }
    }

    // Light of this radiance and degree of linear polarisation, along an axis that is turned by
    // `axis` from the columns' x axis.
    Contribution<transport, N> polarised(const Packet<N>& radiance, const Rotation<float>& axis,
                                         float dop) const {
        Contribution<transport, N> result;
        for (int i = 0; i < rows; ++i) {
            Packet<N> seen = m_[i][0];
            if constexpr (transport != Transport::scalar) {
                seen += Packet<N>(dop) *
                        (Packet<N>(axis.cos2) * m_[i][1] + Packet<N>(axis.sin2) * m_[i][2]);
            }
            result.s[i] = seen * radiance;
        }
        return result;
    }

    // Unpolarised light of this radiance.
    Contribution<transport, N> unpolarised(const Packet<N>& radiance) const {
        Contribution<transport, N> result;
        for (int i = 0; i < rows; ++i) result.s[i] = m_[i][0] * radiance;
        return result;
    }

  private:
    Packet<N> m_[rows][columns];
};

// Projects a contribution on the cone of physical Stokes vectors, S0 >= |S1..3|, from which only
// rounding can take it. Returns the largest excess |S1..3| - S0 that was removed, over S0 or, where
// that is more, `least`.
template <Transport transport, int N>
float project_on_cone(Contribution<transport, N>* c, float least = 0) {
    if constexpr (transport == Transport::stokes) {
        const Packet<N> polarised = sqrt(c->s[1] * c->s[1] + c->s[2] * c->s[2] + c->s[3] * c->s[3]);
        const Packet<N> excess = (polarised - c->s[0]) / max(c->s[0], Packet<N>(least + 1e-30f));
        c->s[0] = max(c->s[0], polarised);
        return max_lane(excess);
    } else {
        c->s[0] = max(c->s[0], Packet<N>(0.0f));
        return 0;
    }
}

}  // namespace drude
