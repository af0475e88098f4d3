#include "scene/messages.h"

#include "scene/scene.h"

namespace drude {

void Messages::add(const Place& place, const std::string& text, bool stand_in) {
    const auto [found, added] = index_.emplace(text, messages_.size());
    if (added) messages_.push_back({place, text, stand_in, 0});
    ++messages_[found->second].count;
}

void Messages::write_to(Scene& scene) const {
    for (const Message& message : messages_) {
        std::string line = message.place.str() + ": " + message.text;
        if (message.count > 1) {
            line += fmt::format(" (and {} more place{} like it)", message.count - 1,
                                message.count == 2 ? "" : "s");
        }
        if (message.stand_in) scene.stand_ins.push_back(line);
        scene.warnings.push_back(std::move(line));
    }
}

}  // namespace drude
