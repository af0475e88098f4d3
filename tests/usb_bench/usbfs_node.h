// A virtual device behind /dev/bus/usb/BBB/DDD, as the ioctls of usbfs show it.
//
// umockdev calls handle() for every ioctl that the client makes on the node; semantics are those of
// Linux, drivers/usb/core/devio.c.
#pragma once

#include <umockdev.h>

#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "usb_bench/virtual_device.h"

namespace drude::usb_bench {

struct NodeFaults {
    bool busy = false;  // somebody else holds the interface
};

class UsbfsNode {
  public:
    // `device` must outlive the node and `lock` guards all devices and nodes of a bench.
    UsbfsNode(VirtualDevice& device, std::mutex& lock, NodeFaults faults);
    ~UsbfsNode();
    UsbfsNode(const UsbfsNode&) = delete;
    UsbfsNode& operator=(const UsbfsNode&) = delete;

    UMockdevIoctlBase* handler() { return handler_; }
    VirtualDevice& device() { return device_; }
    // The device left the bus: transfers come back with what it gave them, everything else is
    // answered by ENODEV from now on.
    void disconnect();

    // The client was killed. umockdev does not notice where an ioctl of its had no answer yet.
    void client_died();

    // What the client still holds: descriptors, interfaces, transfers, and a kernel driver that it
    // took off and did not put back. Empty: nothing. The caller holds the lock.
    std::vector<std::string> held();
    int detached_count() const { return detached_count_; }  // ever
    // What the client did that the kernel complains of.
    const std::vector<std::string>& complaints() const { return complaints_; }

  private:
    static gboolean on_ioctl(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self);
    static void on_connected(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self);
    static void on_closed(UMockdevIoctlClient*, GParamSpec*, gpointer self);
    static gboolean on_wait(gpointer waiting);
    struct Waiting;

    // Sees to what clients left that closed their descriptor, or to what all left.
    void clean_up(bool all = false);
    void handle(UMockdevIoctlClient* client);
    void submit(UMockdevIoctlClient* client, UMockdevIoctlData* argument);
    bool reap(UMockdevIoctlClient* client);
    int claim(UMockdevIoctlClient* client, bool detach);
    int driver_ioctl(UMockdevIoctlData* argument);
    std::optional<Transfer> next_complete();
    void take_complete();

    VirtualDevice& device_;
    std::mutex& lock_;
    NodeFaults faults_;
    UMockdevIoctlBase* handler_;
    bool disconnected_ = false;
    bool driver_bound_;
    int detached_count_ = 0;
    std::set<UMockdevIoctlClient*> clients_;  // one a descriptor, with a reference
    UMockdevIoctlClient* holder_ = nullptr;   // of the interface
    struct Block {
        UMockdevIoctlData* data;
        UMockdevIoctlClient* client;
    };
    std::map<uint64_t, Block> blocks_;  // clients' URBs, by their addresses
    std::deque<Transfer> complete_;
    std::vector<std::string> complaints_;
};

}  // namespace drude::usb_bench
