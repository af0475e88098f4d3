#include "usb_bench/usb_testbed.h"

#include <sys/stat.h>

#include <future>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"

namespace drude::usb_bench {

namespace {

class RootHub : public VirtualDevice {
  public:
    explicit RootHub(FaultPlan& faults) : VirtualDevice(identity_of_hub(), faults) {}

  protected:
    void receive(uint8_t, const Bytes&) override {}
    bool control(Transfer&) override { return false; }
    std::string describe(const Transfer&) const override { return "hub"; }
    void power_on() override {}

  private:
    static Identity identity_of_hub() {
        Identity id;
        id.name = "hub";
        id.vendor = 0x1D6B;
        id.product = 2;
        id.interface_class = 9;
        id.endpoints = {};
        id.manufacturer = "Linux";
        id.product_name = "virtual root hub";
        return id;
    }
};

std::string hexadecimal(const Bytes& bytes) {
    std::string text;
    for (size_t i = 0; i < bytes.size(); ++i) text += fmt::format("{:02X}", byte_at(bytes, i));
    return text;
}

void check(gboolean ok, GError* error, const char* what) {
    if (ok) return;
    const std::string message = error != nullptr ? error->message : "no reason given";
    g_clear_error(&error);
    throw Error(Cause::outside, fmt::format("umockdev: {}: {}", what, message));
}

}  // namespace

UsbTestbed::UsbTestbed()
    : bed_(umockdev_testbed_new()), hub_(std::make_unique<RootHub>(no_faults_)) {
    plug(*hub_, {});
}

UsbTestbed::~UsbTestbed() {
    g_object_unref(bed_);
}

std::string UsbTestbed::root() const {
    gchar* path = umockdev_testbed_get_root_dir(bed_);
    const std::string root = path;
    g_free(path);
    return root;
}

void UsbTestbed::plug(VirtualDevice& device, Trouble trouble) {
    auto port = std::make_unique<Port>();
    port->bed = this;
    port->number = static_cast<int>(ports_.size());
    port->device = &device;
    port->trouble = trouble;
    Port& plugged = *port;
    ports_.push_back(std::move(port));
    device.on_unplug = [this, &plugged](std::optional<int> milliseconds) {
        disappear(plugged, milliseconds);
    };
    appear(plugged);
}

void UsbTestbed::appear(Port& port) {
    const Identity& id = port.device->identity();
    const int address = ++last_address_;  // the kernel gives a device that comes back a new one
    nodes_.push_back(
        std::make_unique<UsbfsNode>(*port.device, lock_, NodeFaults{port.trouble.busy}));
    port.node = nodes_.back().get();
    const std::string node = fmt::format("/dev/bus/usb/001/{:03}", address);
    GError* error = nullptr;
    gboolean ok = umockdev_testbed_attach_ioctl(bed_, node.c_str(), port.node->handler(), &error);
    check(ok, error, "attaching a node");
    std::string path = "/devices/pci0000:00/0000:00:14.0/usb1";
    if (port.number > 0) path += fmt::format("/1-{}", port.number);
    const std::string record = fmt::format(
        "P: {0}\nN: bus/usb/001/{1:03}\nE: SUBSYSTEM=usb\nE: DRIVER=usb\nE: DEVTYPE=usb_device\n"
        "E: BUSNUM=001\nE: DEVNUM={1:03}\nE: MAJOR=189\nE: MINOR={2}\n"
        "E: DEVNAME=/dev/bus/usb/001/{1:03}\nA: busnum=1\\n\nA: devnum={1}\\n\nA: dev=189:{2}\\n\n"
        "A: speed={3}\\n\nA: bConfigurationValue=1\\n\nA: idVendor={4:04x}\\n\n"
        "A: idProduct={5:04x}\\n\nH: descriptors={6}\n",
        path, address, address - 1, id.high_speed ? "480" : "12", id.vendor, id.product,
        hexadecimal(port.device->descriptors()));
    ok = umockdev_testbed_add_from_string(bed_, record.c_str(), &error);
    check(ok, error, "adding a device");
    port.sysfs_path = "/sys" + path;
    if (port.trouble.refused && chmod((root() + node).c_str(), 0) != 0) {
        throw Error(Cause::outside, "cannot close the node " + node);
    }
}

void UsbTestbed::disappear(Port& port, std::optional<int> milliseconds) {
    // In a handler of the devices' thread, with the lock held.
    worker_ = g_main_context_get_thread_default();
    port.node->disconnect();
    umockdev_testbed_uevent(bed_, port.sysfs_path.c_str(), "remove");
    umockdev_testbed_remove_device(bed_, port.sysfs_path.c_str());
    if (!milliseconds) return;
    port.return_expected = true;
    GSource* source = g_timeout_source_new(static_cast<guint>(*milliseconds));
    const auto come_back = [](gpointer data) -> gboolean {
        auto* back = static_cast<Port*>(data);
        const std::lock_guard guard(back->bed->lock_);
        if (back->return_expected) {
            back->return_expected = false;
            back->device->plug_in();
            back->bed->appear(*back);
            umockdev_testbed_uevent(back->bed->bed_, back->sysfs_path.c_str(), "add");
        }
        return G_SOURCE_REMOVE;
    };
    g_source_set_callback(source, come_back, &port, nullptr);
    g_source_attach(source, worker_);
    g_source_unref(source);
}

void UsbTestbed::plug_all_in() {
    if (worker_ == nullptr) return;  // nothing ever left
    std::promise<void> done;
    struct Call {
        UsbTestbed* bed;
        std::promise<void>* done;
    } call{this, &done};
    const auto run = [](gpointer data) -> gboolean {
        auto* asked = static_cast<Call*>(data);
        const std::lock_guard guard(asked->bed->lock_);
        for (const auto& port : asked->bed->ports_) {
            port->return_expected = false;
            if (!port->device->gone()) continue;
            port->device->plug_in();
            asked->bed->appear(*port);
        }
        asked->done->set_value();
        return G_SOURCE_REMOVE;
    };
    g_main_context_invoke(worker_, run, &call);
    done.get_future().wait();
}

std::vector<std::string> UsbTestbed::held() {
    const std::lock_guard guard(lock_);
    std::vector<std::string> all;
    for (const auto& node : nodes_) {
        for (std::string& one : node->held()) all.push_back(std::move(one));
    }
    return all;
}

void UsbTestbed::client_died() {
    const std::lock_guard guard(lock_);
    for (const auto& node : nodes_) node->client_died();
}

int UsbTestbed::detached_count() {
    const std::lock_guard guard(lock_);
    int count = 0;
    for (const auto& node : nodes_) count += node->detached_count();
    return count;
}

std::vector<std::string> UsbTestbed::complaints() {
    const std::lock_guard guard(lock_);
    std::vector<std::string> all;
    for (const auto& node : nodes_) {
        all.insert(all.end(), node->complaints().begin(), node->complaints().end());
    }
    return all;
}

}  // namespace drude::usb_bench
