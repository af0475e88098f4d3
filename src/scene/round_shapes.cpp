// Shapes "sphere", "disk" and "cylinder".
#include <algorithm>

#include "base/numbers.h"
#include "scene/builders.h"

namespace drude {

namespace {

constexpr double largest = 1e15, smallest = 1e-15;

double phi_max(ParameterList& list) {
    return list.number_in("phimax", 360, 1e-3, 360);
}

}  // namespace

Sphere build_sphere(ParameterList& list) {
    Sphere sphere;
    sphere.radius = list.number_in("radius", 1, smallest, largest);
    const double a = list.number("zmin", -sphere.radius), b = list.number("zmax", sphere.radius);
    sphere.z_min = std::clamp(std::min(a, b), -sphere.radius, sphere.radius);
    sphere.z_max = std::clamp(std::max(a, b), -sphere.radius, sphere.radius);
    if (!(sphere.z_max > sphere.z_min)) {
        user_error_at(list.has("zmin") ? list.place_of("zmin") : list.place_of("zmax"),
                      "Shape \"sphere\": nothing is left between zmin {} and zmax {}; expected a "
                      "part of -{} to {}",
                      format_double(a), format_double(b), format_double(sphere.radius),
                      format_double(sphere.radius));
    }
    sphere.phi_max_deg = phi_max(list);
    return sphere;
}

Disk build_disk(ParameterList& list) {
    Disk disk;
    disk.height = list.number_in("height", 0, -largest, largest);
    disk.radius = list.number_in("radius", 1, smallest, largest);
    disk.inner_radius = list.number_in("innerradius", 0, 0, disk.radius);
    if (disk.inner_radius == disk.radius) {
        user_error_at(list.place_of("innerradius"),
                      "Shape \"disk\": innerradius equals radius; expected a smaller one");
    }
    disk.phi_max_deg = phi_max(list);
    return disk;
}

Cylinder build_cylinder(ParameterList& list) {
    Cylinder cylinder;
    cylinder.radius = list.number_in("radius", 1, smallest, largest);
    const double a = list.number_in("zmin", -1, -largest, largest);
    const double b = list.number_in("zmax", 1, -largest, largest);
    if (a == b) {
        user_error_at(list.place_of("zmin"),
                      "Shape \"cylinder\": zmin equals zmax; expected two different heights");
    }
    cylinder.z_min = std::min(a, b);
    cylinder.z_max = std::max(a, b);
    cylinder.phi_max_deg = phi_max(list);
    return cylinder;
}

}  // namespace drude
