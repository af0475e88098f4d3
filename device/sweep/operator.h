// The person at a bench whose parts do not all move by themselves.
#pragma once

#include <string>

namespace drude {

class Operator {
  public:
    virtual ~Operator() = default;
    // Returns when `request` ("set both arms to 70 degrees") is done. Throws Error (user) where
    // nobody can be asked; returns early where a signal asks the program to stop.
    virtual void ask(const std::string& request) = 0;
};

// Asks on stderr and waits for a line on stdin. Without a terminal nobody is there: an Error,
// unless `confirmed` says that whatever is asked for has been seen to.
class TerminalOperator : public Operator {
  public:
    explicit TerminalOperator(bool confirmed) : confirmed_(confirmed) {}
    void ask(const std::string& request) override;

  private:
    bool confirmed_;
};

}  // namespace drude
