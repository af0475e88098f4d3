// PixelFilter "box", "gaussian", "triangle", "mitchell" with pbrt-v4's defaults.
#include "scene/builders.h"
#include "scene/vocabulary.h"

namespace drude {

Filter build_filter(const std::string& name, ParameterList& list, Messages& messages) {
    Filter filter;
    if (name == "sinc") {
        messages.stand_in(list.place(),
                          "PixelFilter \"sinc\" is not modelled; pbrt's default, a gaussian of "
                          "radius 1.5, stands in");
        list.ignore(known_parameters("PixelFilter", name));
        return filter;
    }
    double radius = 2;
    if (name == "box") {
        filter.kind = FilterKind::box;
        radius = 0.5;
    } else if (name == "gaussian") {
        filter.kind = FilterKind::gaussian;
        radius = 1.5;
        filter.sigma = list.number_in("sigma", 0.5, 1e-3, 1e3);
    } else if (name == "triangle") {
        filter.kind = FilterKind::triangle;
    } else {
        filter.kind = FilterKind::mitchell;
        filter.b = list.number_in("B", filter.b, -10, 10);
        filter.c = list.number_in("C", filter.c, -10, 10);
    }
    filter.radius_x = list.number_in("xradius", radius, 1e-3, 64);
    filter.radius_y = list.number_in("yradius", radius, 1e-3, 64);
    list.finish(known_parameters("PixelFilter", name), messages);
    return filter;
}

}  // namespace drude
