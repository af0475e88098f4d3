// The plots of one metal of the study.
#pragma once

#include <string>

#include "report/study_data.h"

namespace drude {

enum class EllipsometricAngle { psi, delta };
// Points as measured, one colour an angle of incidence, with the fitted model's curve.
std::string ellipsometry_plot(const StudyMetal& metal, EllipsometricAngle angle);

enum class ConstantKind { n, k };
// Fitted points with error bars over every published set and the envelope of them all, within the
// measured range.
std::string constants_plot(const StudyMetal& metal, ConstantKind kind);

}  // namespace drude
