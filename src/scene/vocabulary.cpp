#include "scene/vocabulary.h"

#include <algorithm>
#include <map>
#include <sstream>

namespace drude {

namespace {

// "kind name: parameters"; the name "*" gives parameters to everything of its kind. From pbrt-v4's
// file format documentation and its Create() functions (June 2026). Polarisation is this renderer's
// own: analyser, retarder, retarderaxis of cameras; dop, aolp, polarisation, sun of lights; the
// materials linearpolariser, retarder and circularpolariser.
constexpr std::string_view words = R"(
Camera *: shutteropen shutterclose analyser retarder retarderaxis
Camera perspective: frameaspectratio screenwindow lensradius focaldistance fov
Camera orthographic: frameaspectratio screenwindow lensradius focaldistance
Camera realistic: lensfile aperturediameter focusdistance aperture
Camera spherical: mapping lensradius focaldistance frameaspectratio screenwindow
Film *: xresolution yresolution cropwindow pixelbounds diagonal filename savefp16
Film *: sensor iso exposuretime whitebalance maxcomponentvalue
Film rgb:
Film gbuffer: coordinatesystem
Film spectral: nbuckets lambdamin lambdamax
Sampler *: seed randomization
Sampler zsobol: pixelsamples
Sampler paddedsobol: pixelsamples
Sampler sobol: pixelsamples
Sampler halton: pixelsamples
Sampler pmj02bn: pixelsamples
Sampler independent: pixelsamples
Sampler stratified: xsamples ysamples jitter
PixelFilter *: xradius yradius
PixelFilter box:
PixelFilter gaussian: sigma
PixelFilter mitchell: B C
PixelFilter sinc: tau
PixelFilter triangle:
Integrator *: regularize lightsampler
Integrator path: maxdepth
Integrator volpath: maxdepth
Integrator simplepath: maxdepth samplelights samplebsdf
Integrator simplevolpath: maxdepth
Integrator randomwalk: maxdepth
Integrator lightpath: maxdepth
Integrator bdpt: maxdepth visualizestrategies visualizeweights
Integrator mlt: maxdepth bootstrapsamples chains mutationsperpixel largestepprobability sigma
Integrator sppm: maxdepth photonsperiteration radius seed
Integrator ambientocclusion: cossample maxdistance
Integrator function: function skipbad imagefile imagefilename
Accelerator bvh: maxnodeprims splitmethod
Accelerator kdtree: intersectcost traversalcost emptybonus maxprims maxdepth
Option disablepixeljitter:
Option disabletexturefiltering:
Option disablewavelengthjitter:
Option displacementedgescale:
Option forcediffuse:
Option msereferenceimage:
Option msereferenceout:
Option pixelmaterial:
Option pixelstats:
Option rendercoordsys:
Option seed:
Option wavefront:
Shape *: alpha
Shape sphere: radius zmin zmax phimax
Shape disk: height radius innerradius phimax
Shape cylinder: radius zmin zmax phimax
Shape trianglemesh: indices P N S uv faceIndices
Shape plymesh: filename displacement displacement.edgelength displacement.uvscale edgelength
Shape bilinearmesh: indices P N uv faceIndices emissionfilename
Shape loopsubdiv: levels indices P scheme
Shape curve: P type basis degree width width0 width1 N splitdepth
Material *: displacement normalmap
Material conductor: eta k reflectance roughness uroughness vroughness remaproughness
Material diffuse: reflectance
Material dielectric: eta roughness uroughness vroughness remaproughness
Material thindielectric: eta
Material diffusetransmission: reflectance transmittance scale
Material coateddiffuse: reflectance roughness uroughness vroughness remaproughness thickness eta
Material coateddiffuse: g albedo maxdepth nsamples twosided
Material coatedconductor: interface.roughness interface.uroughness interface.vroughness
Material coatedconductor: interface.eta thickness conductor.eta conductor.k reflectance
Material coatedconductor: conductor.roughness conductor.uroughness conductor.vroughness
Material coatedconductor: remaproughness g albedo maxdepth nsamples
Material subsurface: name sigma_a sigma_s reflectance mfp scale eta g
Material subsurface: roughness uroughness vroughness remaproughness
Material hair: sigma_a reflectance color eumelanin pheomelanin eta beta_m beta_n alpha
Material measured: filename
Material mix: materials amount
Material interface:
Material linearpolariser: axis transmittance
Material retarder: axis retardance transmittance
Material circularpolariser: righthanded transmittance
LightSource *: dop aolp
LightSource point: I scale power from
LightSource spot: I scale power from to coneangle conedeltaangle
LightSource goniometric: I scale power filename
LightSource projection: I scale power fov filename
LightSource distant: L scale illuminance from to
LightSource infinite: L scale illuminance filename portal
LightSource infinite: polarisation sun
AreaLightSource diffuse: L scale power twosided filename dop aolp
MakeNamedMedium *: type preset sigma_a sigma_s scale g Le Lescale
MakeNamedMedium homogeneous:
MakeNamedMedium uniformgrid: nx ny nz p0 p1 density temperature temperatureoffset
MakeNamedMedium uniformgrid: temperaturecutoff temperaturescale
MakeNamedMedium rgbgrid: nx ny nz p0 p1
MakeNamedMedium cloud: p0 p1 density wispiness frequency
MakeNamedMedium nanovdb: filename temperatureoffset temperaturecutoff temperaturescale LeScale
Texture *: mapping uscale vscale udelta vdelta v1 v2
Texture constant: value
Texture scale: tex scale
Texture mix: tex1 tex2 amount
Texture directionmix: tex1 tex2 dir
Texture bilerp: v00 v01 v10 v11
Texture imagemap: filename wrap filter maxanisotropy scale invert encoding
Texture checkerboard: dimension tex1 tex2
Texture dots: inside outside
Texture fbm: octaves roughness
Texture wrinkled: octaves roughness
Texture windy:
Texture marble: octaves roughness scale variation
Texture ptex: filename encoding scale
ColorSpace srgb:
ColorSpace rec2020:
ColorSpace dci-p3:
ColorSpace aces2065-1:
)";

using Names = std::map<std::string, std::vector<std::string>, std::less<>>;

const std::map<std::string, Names, std::less<>>& table() {
    static const std::map<std::string, Names, std::less<>> result = [] {
        std::map<std::string, Names, std::less<>> kinds;
        std::istringstream lines{std::string(words)};
        for (std::string line; std::getline(lines, line);) {
            std::istringstream fields(line);
            std::string kind, name, parameter;
            if (!(fields >> kind >> name)) continue;
            name.pop_back();
            std::vector<std::string>& parameters = kinds[kind][name];
            while (fields >> parameter) parameters.push_back(parameter);
        }
        return kinds;
    }();
    return result;
}

}  // namespace

std::vector<std::string> known_names(std::string_view kind) {
    std::vector<std::string> names;
    const auto found = table().find(kind);
    if (found == table().end()) return names;
    for (const auto& entry : found->second) {
        if (entry.first != "*") names.push_back(entry.first);
    }
    return names;
}

bool is_known_name(std::string_view kind, std::string_view name) {
    const auto found = table().find(kind);
    return found != table().end() && name != "*" && found->second.find(name) != found->second.end();
}

std::vector<std::string> known_parameters(std::string_view kind, std::string_view name) {
    std::vector<std::string> parameters;
    const auto found = table().find(kind);
    if (found == table().end()) return parameters;
    for (const auto& entry : found->second) {
        if (name.empty() || entry.first == name || entry.first == "*") {
            parameters.insert(parameters.end(), entry.second.begin(), entry.second.end());
        }
    }
    std::sort(parameters.begin(), parameters.end());
    parameters.erase(std::unique(parameters.begin(), parameters.end()), parameters.end());
    return parameters;
}

}  // namespace drude
