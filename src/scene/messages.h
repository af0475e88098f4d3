// What a reader of scenes has to say that is no error, each thing once.
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "base/error.h"

namespace drude {

struct Scene;

class Messages {
  public:
    // Something done as asked that a person should know of: a name resolved, a range held.
    void note(const Place& place, const std::string& text) { add(place, text, false); }
    // pbrt-v4 knows it and this renderer does not: `text` names what stands in.
    void stand_in(const Place& place, const std::string& text) { add(place, text, true); }

    // "file:line:column: text", with the number of further places of the same text.
    void write_to(Scene& scene) const;

  private:
    struct Message {
        Place place;
        std::string text;
        bool stand_in = false;
        int count = 0;
    };
    void add(const Place& place, const std::string& text, bool stand_in);

    std::vector<Message> messages_;
    std::unordered_map<std::string, size_t> index_;
};

}  // namespace drude
