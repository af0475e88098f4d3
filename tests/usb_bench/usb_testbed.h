// The mocked /sys and /dev in which clients find the virtual devices, with plugging and unplugging.
#pragma once

#include <umockdev.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "usb_bench/usbfs_node.h"

namespace drude::usb_bench {

class UsbTestbed {
  public:
    // Must run under umockdev's preload library, which the caller sees to.
    UsbTestbed();
    ~UsbTestbed();
    UsbTestbed(const UsbTestbed&) = delete;
    UsbTestbed& operator=(const UsbTestbed&) = delete;

    struct Trouble {
        bool refused = false;  // its node may not be opened
        bool busy = false;     // somebody else holds its interface
    };
    // The device must outlive the test bed.
    void plug(VirtualDevice& device, Trouble trouble);
    // Plugs in what is unplugged; from another thread than that of the devices.
    void plug_all_in();

    std::mutex& lock() { return lock_; }
    std::string root() const;  // the folder that holds the mocked /dev
    // What clients hold at the moment (UsbfsNode::held()).
    std::vector<std::string> held();
    void client_died();
    int detached_count();
    std::vector<std::string> complaints();

  private:
    struct Port {
        UsbTestbed* bed = nullptr;
        int number = 0;
        VirtualDevice* device = nullptr;
        Trouble trouble;
        std::string sysfs_path;
        UsbfsNode* node = nullptr;  // the present one
        bool return_expected = false;
    };
    void appear(Port& port);
    void disappear(Port& port, std::optional<int> milliseconds);

    UMockdevTestbed* bed_;
    std::mutex lock_;
    FaultPlan no_faults_;
    std::unique_ptr<VirtualDevice> hub_;
    std::vector<std::unique_ptr<Port>> ports_;
    std::vector<std::unique_ptr<UsbfsNode>> nodes_;  // also of devices that left: clients hold them
    GMainContext* worker_ = nullptr;
    int last_address_ = 0;
};

}  // namespace drude::usb_bench
