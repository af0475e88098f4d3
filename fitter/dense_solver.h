// How the small problems of this room are given to Ceres.
#pragma once

#include <ceres/solver.h>

namespace drude {

// Dense QR on one thread, in silence: the loops around the problems are what runs in parallel.
// `tolerance` ends a solution by the change of the function and by that of the parameters.
inline ceres::Solver::Options dense_solver(int most_steps, double tolerance) {
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.logging_type = ceres::SILENT;
    options.num_threads = 1;
    options.max_num_iterations = most_steps;
    options.function_tolerance = tolerance;
    options.parameter_tolerance = tolerance;
    return options;
}

}  // namespace drude
