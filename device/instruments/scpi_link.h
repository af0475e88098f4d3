// Questions and commands to an SCPI instrument, with its error queue read after each.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "device/instruments/scpi_commands.h"
#include "device/instruments/usbtmc.h"

namespace drude {

class ScpiLink {
  public:
    // Asks who it is. Throws DeviceError.
    ScpiLink(std::shared_ptr<UsbPort> port, ScpiCommands commands);

    const ScpiCommands& commands() const { return commands_; }
    const ScpiIdentity& identity() const { return identity_; }
    std::string name() const { return tmc_.name(); }
    // "usbtmc:1209:5e11:SERIAL".
    std::string uri();

    // The answer without its line feed. Throws DeviceError: that of the transfer, or refused with
    // the errors that the instrument's queue holds afterwards.
    std::string ask(const std::string& question, double seconds);
    std::vector<double> ask_numbers(const std::string& question, double seconds);
    // Sends a command and waits until the instrument says that it is done.
    void command(const std::string& text, double seconds);
    // Wavelengths in nanometres; DeviceError (bad_frame) where they do not ascend.
    std::vector<double> wavelengths();

    // Clears buffers on both sides and the error queue.
    void recover();
    // Also asks who it is: DeviceError (refused) where another instrument came back.
    bool reconnect(double seconds);

  private:
    void start();
    std::string ask_once(const std::string& question, double seconds);
    void check_errors(const std::string& about);

    Usbtmc tmc_;
    ScpiCommands commands_;
    ScpiIdentity identity_;
};

}  // namespace drude
