// Time as a bench sees it: the real one, or that of a virtual bench, which does not wait.
#pragma once

namespace drude {

class BenchClock {
  public:
    virtual ~BenchClock() = default;
    // Seconds, never falling; the zero is arbitrary.
    virtual double now() const = 0;
    // Returns when now() has advanced by `seconds` >= 0, or earlier where a signal asks the
    // program to stop (base/interrupt.h).
    virtual void sleep(double seconds) = 0;
};

// The steady clock of the machine.
BenchClock& real_clock();

// Advances only when told to: a virtual bench measures for an hour in a second.
class VirtualClock : public BenchClock {
  public:
    double now() const override { return now_; }
    void sleep(double seconds) override { now_ += seconds; }

  private:
    double now_ = 0;
};

}  // namespace drude
