// Nodes and weights of numerical integration.
#pragma once

#include <vector>

namespace drude {

struct QuadratureRule {
    std::vector<double> x, weight;
};

// Gauss-Legendre on [-1, 1], x descending, the weights' sum 2: exact for polynomials of degree
// 2 count - 1. Newton's method on P_n from its recurrence (Abramowitz & Stegun 1964, 22.7.10,
// 25.4.29). `count` from 1; below, nothing.
QuadratureRule gauss_legendre(int count);

}  // namespace drude
