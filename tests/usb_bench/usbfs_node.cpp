#include "usb_bench/usbfs_node.h"

#include <linux/usbdevice_fs.h>
#include <sys/ioctl.h>

#include <cerrno>
#include <cstddef>
#include <cstring>
#include <utility>

#include <fmt/format.h>

namespace drude::usb_bench {

namespace {

// What the client's pointer points to, copied here and written back when the ioctl completes;
// nothing where the client is gone.
UMockdevIoctlData* resolve(UMockdevIoctlData* data, size_t offset, size_t size) {
    return umockdev_ioctl_data_resolve(data, offset, size, nullptr);
}

template <class T>
T* view(UMockdevIoctlData* data) {
    return static_cast<T*>(static_cast<void*>(data->data));
}

// ioctl numbers are unsigned int to the kernel; glibc passes unsigned long.
constexpr unsigned number_of(unsigned long request) {
    return static_cast<unsigned>(request);
}

void complete(UMockdevIoctlClient* client, int result, int error) {
    if (umockdev_ioctl_client_get_connected(client)) {
        umockdev_ioctl_client_complete(client, result, error);
    }
}

}  // namespace

struct UsbfsNode::Waiting {
    UsbfsNode* node;
    UMockdevIoctlClient* client;
    int ticks_left;
};

UsbfsNode::UsbfsNode(VirtualDevice& device, std::mutex& lock, NodeFaults faults)
    : device_(device),
      lock_(lock),
      faults_(faults),
      handler_(umockdev_ioctl_base_new()),
      driver_bound_(!device.identity().kernel_driver.empty()) {
    g_signal_connect(handler_, "handle-ioctl", G_CALLBACK(on_ioctl), this);
    g_signal_connect(handler_, "client-connected", G_CALLBACK(on_connected), this);
}

UsbfsNode::~UsbfsNode() {
    for (UMockdevIoctlClient* client : clients_) {
        g_signal_handlers_disconnect_by_data(client, this);
        g_object_unref(client);
    }
    g_signal_handlers_disconnect_by_data(handler_, this);
    g_object_unref(handler_);
}

gboolean UsbfsNode::on_ioctl(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self) {
    auto* node = static_cast<UsbfsNode*>(self);
    const std::lock_guard guard(node->lock_);
    node->handle(client);
    return TRUE;
}

void UsbfsNode::on_connected(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self) {
    auto* node = static_cast<UsbfsNode*>(self);
    const std::lock_guard guard(node->lock_);
    node->clean_up();
    node->clients_.insert(client);
    g_object_ref(client);
    // The signal that is called client-vanished never comes (umockdev 0.17.16).
    g_signal_connect(client, "notify::connected", G_CALLBACK(on_closed), self);
}

void UsbfsNode::on_closed(UMockdevIoctlClient*, GParamSpec*, gpointer self) {
    auto* node = static_cast<UsbfsNode*>(self);
    const std::lock_guard guard(node->lock_);
    node->clean_up();
}

void UsbfsNode::client_died() {
    clean_up(true);
}

void UsbfsNode::clean_up(bool all) {
    for (auto it = clients_.begin(); it != clients_.end();) {
        UMockdevIoctlClient* client = *it;
        const bool connected = umockdev_ioctl_client_get_connected(client);
        if (connected && !all) {
            ++it;
            continue;
        }
        it = clients_.erase(it);
        if (holder_ == client) holder_ = nullptr;
        // The kernel kills what a closed descriptor left in flight; it binds no driver again.
        for (auto block = blocks_.begin(); block != blocks_.end();) {
            if (block->second.client != client) {
                ++block;
                continue;
            }
            if (!disconnected_) device_.forget(block->first);
            g_object_unref(block->second.data);
            block = blocks_.erase(block);
        }
        g_signal_handlers_disconnect_by_data(client, this);
        g_object_unref(client);
    }
}

void UsbfsNode::take_complete() {
    while (std::optional<Transfer> transfer = device_.reap()) {
        complete_.push_back(std::move(*transfer));
    }
}

void UsbfsNode::disconnect() {
    take_complete();
    disconnected_ = true;
    holder_ = nullptr;
}

std::vector<std::string> UsbfsNode::held() {
    clean_up();
    std::vector<std::string> held;
    const std::string& name = device_.identity().name;
    if (!clients_.empty()) held.push_back(fmt::format("{}: {} descriptors", name, clients_.size()));
    if (holder_ != nullptr) held.push_back(name + ": its interface is claimed");
    if (!blocks_.empty()) held.push_back(fmt::format("{}: {} transfers", name, blocks_.size()));
    if (!disconnected_ && !driver_bound_ && !device_.identity().kernel_driver.empty()) {
        held.push_back(fmt::format("{}: {} was detached and is not back", name,
                                   device_.identity().kernel_driver));
    }
    return held;
}

std::optional<Transfer> UsbfsNode::next_complete() {
    if (disconnected_) {
        if (complete_.empty()) return std::nullopt;
        Transfer first = std::move(complete_.front());
        complete_.pop_front();
        return first;
    }
    return device_.reap();
}

bool UsbfsNode::reap(UMockdevIoctlClient* client) {
    const std::optional<Transfer> transfer = next_complete();
    if (!transfer) return false;
    const auto found = blocks_.find(transfer->cookie);
    if (found == blocks_.end()) return false;
    UMockdevIoctlData* block = found->second.data;
    blocks_.erase(found);
    auto* urb = view<usbdevfs_urb>(block);
    urb->status = transfer->status;
    const size_t offset = transfer->type == TransferType::control ? 8 : 0;
    if (transfer->incoming()) {
        std::memcpy(static_cast<char*>(urb->buffer) + offset, transfer->data.data(),
                    transfer->data.size());
        urb->actual_length = static_cast<int>(transfer->data.size());
    } else {
        urb->actual_length = transfer->status == 0 ? static_cast<int>(transfer->length) : 0;
    }
    UMockdevIoctlData* pointer = resolve(umockdev_ioctl_client_get_arg(client), 0, sizeof(void*));
    if (pointer != nullptr) {
        umockdev_ioctl_data_set_ptr(pointer, 0, block);
        complete(client, 0, 0);
        g_object_unref(pointer);
    }
    g_object_unref(block);
    return true;
}

// poll() says at all times that the node is ready, and libusb would spin: a reap that finds nothing
// is held back for up to two milliseconds.
gboolean UsbfsNode::on_wait(gpointer data) {
    auto* waiting = static_cast<Waiting*>(data);
    bool over = false;
    {
        const std::lock_guard guard(waiting->node->lock_);
        over = waiting->node->clients_.count(waiting->client) == 0 ||
               !umockdev_ioctl_client_get_connected(waiting->client) ||
               waiting->node->reap(waiting->client);
        if (!over && --waiting->ticks_left <= 0) {
            complete(waiting->client, -1, waiting->node->disconnected_ ? ENODEV : EAGAIN);
            over = true;
        }
    }
    if (!over) return G_SOURCE_CONTINUE;
    g_object_unref(waiting->client);
    delete waiting;
    return G_SOURCE_REMOVE;
}

void UsbfsNode::submit(UMockdevIoctlClient* client, UMockdevIoctlData* argument) {
    UMockdevIoctlData* block = resolve(argument, 0, sizeof(usbdevfs_urb));
    if (block == nullptr) return;
    auto* urb = view<usbdevfs_urb>(block);
    const auto size = static_cast<size_t>(urb->buffer_length);
    UMockdevIoctlData* buffer = resolve(block, offsetof(usbdevfs_urb, buffer), size);
    const char* bytes =
        buffer != nullptr ? static_cast<char*>(static_cast<void*>(buffer->data)) : nullptr;
    Transfer transfer;
    transfer.type = static_cast<TransferType>(urb->type);
    transfer.endpoint = urb->endpoint;
    transfer.length = size;
    transfer.cookie = block->client_addr;
    if (transfer.type == TransferType::control) {
        if (size < 8 || bytes == nullptr) {
            g_object_unref(block);
            complete(client, -1, EINVAL);
            return;
        }
        std::memcpy(transfer.setup.data(), bytes, 8);
        transfer.length = size - 8;
        bytes += 8;
    } else if (holder_ != client) {
        complaints_.push_back(
            fmt::format("{}: a transfer without claiming the interface", device_.identity().name));
    }
    if (!transfer.incoming() && bytes != nullptr) transfer.data.assign(bytes, transfer.length);
    blocks_[transfer.cookie] = {block, client};
    device_.submit(std::move(transfer));
    // It may have left the bus because of this very transfer.
    if (disconnected_) take_complete();
    complete(client, 0, 0);
    if (buffer != nullptr) g_object_unref(buffer);
}

int UsbfsNode::claim(UMockdevIoctlClient* client, bool detach) {
    if (faults_.busy || (holder_ != nullptr && holder_ != client)) return EBUSY;
    if (driver_bound_ && !detach) return EBUSY;
    if (driver_bound_) {
        driver_bound_ = false;
        ++detached_count_;
    }
    holder_ = client;
    return 0;
}

int UsbfsNode::driver_ioctl(UMockdevIoctlData* argument) {
    UMockdevIoctlData* data = resolve(argument, 0, sizeof(usbdevfs_ioctl));
    if (data == nullptr) return ENODEV;
    const auto code = number_of(static_cast<unsigned long>(view<usbdevfs_ioctl>(data)->ioctl_code));
    g_object_unref(data);
    if (code == number_of(USBDEVFS_DISCONNECT)) {
        if (!driver_bound_) return ENODATA;
        driver_bound_ = false;
        ++detached_count_;
        return 0;
    }
    if (code == number_of(USBDEVFS_CONNECT)) {
        // What is claimed through usbfs cannot be bound.
        if (holder_ != nullptr) return EBUSY;
        driver_bound_ = !device_.identity().kernel_driver.empty();
        return 0;
    }
    return ENOTTY;
}

void UsbfsNode::handle(UMockdevIoctlClient* client) {
    clean_up();
    UMockdevIoctlData* argument = umockdev_ioctl_client_get_arg(client);
    const unsigned request = number_of(umockdev_ioctl_client_get_request(client));
    const bool after_all = request == number_of(USBDEVFS_REAPURBNDELAY) ||
                           request == number_of(USBDEVFS_REAPURB) ||
                           request == number_of(USBDEVFS_DISCARDURB) ||
                           request == number_of(USBDEVFS_RELEASEINTERFACE);
    if (disconnected_ && !after_all) {
        complete(client, -1, ENODEV);
        return;
    }
    const auto answer = [&](int error) { complete(client, error == 0 ? 0 : -1, error); };
    switch (request) {
        case number_of(USBDEVFS_GET_CAPABILITIES):
            if (UMockdevIoctlData* data = resolve(argument, 0, 4)) {
                *view<uint32_t>(data) = USBDEVFS_CAP_ZERO_PACKET | USBDEVFS_CAP_BULK_CONTINUATION |
                                        USBDEVFS_CAP_NO_PACKET_SIZE_LIM |
                                        USBDEVFS_CAP_BULK_SCATTER_GATHER |
                                        USBDEVFS_CAP_REAP_AFTER_DISCONNECT;
                answer(0);
                g_object_unref(data);
            }
            return;
        case number_of(USBDEVFS_CLEAR_HALT):
            if (UMockdevIoctlData* data = resolve(argument, 0, 4)) {
                device_.clear_halt(static_cast<uint8_t>(*view<uint32_t>(data)));
                answer(0);
                g_object_unref(data);
            }
            return;
        case number_of(USBDEVFS_RESET):
            device_.reset();
            return answer(0);
        case number_of(USBDEVFS_CLAIMINTERFACE):
            return answer(claim(client, false));
        case number_of(USBDEVFS_DISCONNECT_CLAIM):
            return answer(claim(client, true));
        case number_of(USBDEVFS_RELEASEINTERFACE):
            if (holder_ != client) return answer(disconnected_ ? ENODEV : EINVAL);
            holder_ = nullptr;
            return answer(0);
        case number_of(USBDEVFS_SETCONFIGURATION):
        case number_of(USBDEVFS_SETINTERFACE):
            return answer(0);
        case number_of(USBDEVFS_GETDRIVER):
            if (!driver_bound_ && holder_ == nullptr) return answer(ENODATA);
            if (UMockdevIoctlData* data = resolve(argument, 0, sizeof(usbdevfs_getdriver))) {
                const std::string name =
                    holder_ != nullptr ? "usbfs" : device_.identity().kernel_driver;
                auto* driver = view<usbdevfs_getdriver>(data);
                std::memset(driver->driver, 0, sizeof driver->driver);
                name.copy(driver->driver, sizeof driver->driver - 1);
                answer(0);
                g_object_unref(data);
            }
            return;
        case number_of(USBDEVFS_IOCTL):
            return answer(driver_ioctl(argument));
        case number_of(USBDEVFS_GET_SPEED):
            // enum usb_device_speed: 2 full, 3 high.
            return complete(client, device_.identity().high_speed ? 3 : 2, 0);
        case number_of(USBDEVFS_SUBMITURB):
            return submit(client, argument);
        case number_of(USBDEVFS_DISCARDURB): {
            uint64_t cookie = 0;
            std::memcpy(&cookie, argument->data, sizeof cookie);
            return answer(!disconnected_ && device_.cancel(cookie) ? 0 : EINVAL);
        }
        case number_of(USBDEVFS_REAPURBNDELAY):
        case number_of(USBDEVFS_REAPURB): {
            if (reap(client)) return;
            auto* waiting = new Waiting{this, client, 2};
            g_object_ref(client);
            GSource* source = g_timeout_source_new(1);
            g_source_set_callback(source, on_wait, waiting, nullptr);
            g_source_attach(source, g_main_context_get_thread_default());
            g_source_unref(source);
            return;
        }
        default:
            complaints_.push_back(
                fmt::format("{}: unknown ioctl {:08x}", device_.identity().name, request));
            return answer(ENOTTY);
    }
}

}  // namespace drude::usb_bench
