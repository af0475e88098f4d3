// Materials, textures, lights, shapes and instances of SceneReader.
#include "scene/scene_reader.h"
#include "scene/transforms.h"
#include "scene/vocabulary.h"

namespace drude {

namespace {

// Shape::material of a name that is resolved at the end.
int slot_reference(size_t slot) {
    return -2 - static_cast<int>(slot);
}
size_t slot_of(int reference) {
    return static_cast<size_t>(-2 - reference);
}

// Instances are copied: beyond this many vertices and triangles that is no way to draw them. What a
// shape is apart from them, its matrix and its place, weighs as much as so many.
constexpr size_t most_copied = 50'000'000, weight_of_shape = 20;

size_t size_of(const Shape& shape) {
    const TriangleMesh* mesh = std::get_if<TriangleMesh>(&shape.geometry);
    return weight_of_shape +
           (mesh == nullptr ? 0 : mesh->positions.size() + mesh->triangles.size());
}

}  // namespace

int SceneReader::add_material(const std::string& name, ParameterList& list) {
    add_defaults(list, "material");
    std::optional<SurfaceMaterial> material = build_material(name, list, context_);
    if (!material) return -1;
    const int index = static_cast<int>(scene_.materials.size());
    if (std::holds_alternative<MixMaterial>(*material)) mixes_[index] = list.place();
    scene_.materials.push_back(std::move(*material));
    return index;
}

void SceneReader::material(const std::string& name, ParameterList list) {
    require_world(list.place(), "Material");
    state_.material = add_material(name, list);
}

size_t SceneReader::name_slot(const std::string& name, const Place& place) {
    const auto [entry, added] = material_slots_.emplace(name, named_materials_.size());
    if (added) named_materials_.push_back({name, {}, place});
    return entry->second;
}

void SceneReader::make_named_material(const std::string& name, const std::string& type,
                                      ParameterList list) {
    require_world(list.place(), "MakeNamedMaterial");
    const size_t slot = name_slot(name, list.place());
    if (named_materials_[slot].material) {
        user_error_at(list.place(), "the material '{}' is defined twice; expected another name",
                      shown(name));
    }
    named_materials_[slot].material = add_material(type, list);
}

void SceneReader::named_material(const std::string& name, const Place& place) {
    require_world(place, "NamedMaterial");
    // pbrt looks names up at the end, so the definition may still follow.
    state_.material = material_reference(name, place);
}

int SceneReader::material_reference(const std::string& name, const Place& place) {
    return slot_reference(name_slot(name, place));
}

int SceneReader::resolved(int material) const {
    return material < -1 ? *named_materials_[slot_of(material)].material : material;
}

// A mix may be made of mixes, but not of itself.
void SceneReader::resolve_mixes() {
    for (auto& entry : mixes_) {
        auto& mix = std::get<MixMaterial>(scene_.materials[entry.first]);
        mix.first = resolved(mix.first);
        mix.second = resolved(mix.second);
    }
    std::set<int> done;
    for (const auto& start : mixes_) {
        // Depth first; `path` holds the mixes that are being looked into.
        std::vector<std::pair<int, int>> path{{start.first, 0}};
        std::set<int> open{start.first};
        while (!path.empty()) {
            auto& [index, part] = path.back();
            if (part == 2 || done.count(index) > 0) {
                done.insert(index);
                open.erase(index);
                path.pop_back();
                continue;
            }
            const MixMaterial& mix = std::get<MixMaterial>(scene_.materials[index]);
            const int next = part++ == 0 ? mix.first : mix.second;
            if (mixes_.find(next) == mixes_.end()) continue;
            if (!open.insert(next).second) {
                user_error_at(mixes_.at(next),
                              "this mix is made of itself; expected materials that are defined "
                              "without it");
            }
            path.emplace_back(next, 0);
        }
    }
}

void SceneReader::texture(const std::string& name, bool is_spectrum, const std::string& type,
                          ParameterList list) {
    require_world(list.place(), "Texture");
    add_defaults(list, "texture");
    build_texture(name, is_spectrum, type, list, state_.ctm, context_);
}

void SceneReader::light(const std::string& name, ParameterList list) {
    require_world(list.place(), "LightSource");
    add_defaults(list, "light");
    build_light(name, list, state_.ctm, context_, scene_);
}

void SceneReader::area_light(const std::string& name, ParameterList list) {
    require_world(list.place(), "AreaLightSource");
    add_defaults(list, "light");
    state_.area_light = std::make_shared<PendingAreaLight>();
    state_.area_light->recipe = build_area_light(name, list, context_);
}

void SceneReader::note_dark_interface(const Place& place) {
    messages_.note(place, "a shape of material \"interface\" emits no light, as in pbrt-v4");
}

int SceneReader::area_light_of(const ShapeGeometry& geometry, const Place& place) {
    if (!state_.area_light) return -1;
    if (state_.material == -1) {
        note_dark_interface(place);
        return -1;
    }
    if (open_object_ != nullptr) {
        messages_.note(place, "a shape within an object emits no light, as in pbrt-v4");
        return -1;
    }
    PendingAreaLight& pending = *state_.area_light;
    const bool shared = !(pending.recipe.power > 0);
    if (shared && pending.index >= 0) return pending.index;
    const double area = shared ? 1 : surface_area(geometry, state_.ctm);
    scene_.area_lights.push_back(area_light_on(pending.recipe, area));
    pending.index = static_cast<int>(scene_.area_lights.size()) - 1;
    return pending.index;
}

void SceneReader::shape(const std::string& name, ParameterList list) {
    require_world(list.place(), "Shape");
    add_defaults(list, "shape");
    std::optional<ShapeGeometry> geometry = build_shape(name, list, context_);
    if (!geometry) return;
    Shape shape;
    shape.area_light = area_light_of(*geometry, list.place());
    shape.geometry = std::move(*geometry);
    shape.world_from_object = state_.ctm;
    shape.reverse_orientation = state_.reverse_orientation;
    shape.material = state_.material;
    shape.place = list.place();
    (open_object_ != nullptr ? *open_object_ : scene_.shapes).push_back(std::move(shape));
}

void SceneReader::make_named_medium(const std::string& name, const std::string& type,
                                    ParameterList list) {
    if (!media_.insert(name).second) {
        user_error_at(list.place(), "the medium '{}' is defined twice; expected another name",
                      shown(name));
    }
    messages_.stand_in(list.place(), fmt::format("MakeNamedMedium of type \"{}\": media are not "
                                                 "modelled; vacuum stands in",
                                                 type));
    list.ignore(known_parameters("MakeNamedMedium", type));
}

void SceneReader::medium_interface(const std::string& inside, const std::string& outside,
                                   const Place& place) {
    for (const std::string& name : {inside, outside}) {
        if (name.empty()) continue;
        if (media_.find(name) == media_.end()) {
            const std::vector<std::string> names(media_.begin(), media_.end());
            user_error_at(place, "there is no medium '{}'{}; expected one that is defined before",
                          shown(name), did_you_mean(name, names));
        }
        messages_.stand_in(place, "MediumInterface: media are not modelled; vacuum stands in");
    }
}

void SceneReader::resolve_materials() {
    for (const NamedMaterial& named : named_materials_) {
        if (named.material) continue;
        std::vector<std::string> names;
        for (const NamedMaterial& other : named_materials_) {
            if (other.material) names.push_back(other.name);
        }
        user_error_at(named.first_use, "there is no material '{}'{}; expected a MakeNamedMaterial",
                      shown(named.name), did_you_mean(named.name, names));
    }
    resolve_mixes();
    resolve_materials(scene_.shapes);
    for (auto& object : objects_) resolve_materials(object.second);
}

void SceneReader::resolve_materials(std::vector<Shape>& shapes) {
    for (Shape& shape : shapes) {
        shape.material = resolved(shape.material);
        if (shape.area_light < 0) continue;
        if (shape.material < 0) {
            note_dark_interface(shape.place);
            shape.area_light = -1;
        } else if (std::holds_alternative<OpticalElementMaterial>(
                       scene_.materials[static_cast<size_t>(shape.material)])) {
            messages_.note(shape.place,
                           "a polariser or retarder emits no light: the shape is dark");
            shape.area_light = -1;
        }
    }
}

void SceneReader::expand_instances() {
    size_t copied = 0;
    for (const Instance& instance : instances_) {
        const auto object = objects_.find(instance.object);
        if (object == objects_.end()) {
            std::vector<std::string> names;
            for (const auto& entry : objects_) names.push_back(entry.first);
            user_error_at(instance.place, "there is no object '{}'{}; expected an ObjectBegin",
                          shown(instance.object), did_you_mean(instance.object, names));
        }
        for (const Shape& shape : object->second) {
            copied += size_of(shape);
            if (copied > most_copied) {
                user_error_at(instance.place,
                              "the instances up to here come to more than {} vertices and "
                              "triangles; expected fewer, since every instance is a copy",
                              most_copied);
            }
            Shape copy = shape;
            copy.world_from_object = instance.ctm * shape.world_from_object;
            check_matrix(copy.world_from_object, instance.place);
            scene_.shapes.push_back(std::move(copy));
        }
    }
}

}  // namespace drude
