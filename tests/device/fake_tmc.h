// An instrument of the USBTMC class for tests: parses what it is sent strictly, answers questions
// from a table, and hangs, aborts and clears as the class specification has it.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "device/ftdi_packets.h"

namespace drude {

class FakeTmc {
  public:
    class Port : public FakeUsbPort {
      public:
        uint8_t interface_ = 0;

        uint8_t interface_number() const override { return interface_; }
        std::vector<std::pair<uint8_t, uint8_t>> endpoints() const override {
            std::vector<std::pair<uint8_t, uint8_t>> result;
            for (const auto& [endpoint, size] : packet_sizes_) {
                result.emplace_back(endpoint, endpoint == 0x83 ? 3 : 2);
            }
            return result;
        }
    };

    std::shared_ptr<Port> port = std::make_shared<Port>();
    std::map<std::string, std::string> answers;  // by question, without its line feed
    // Asked where the table has nothing.
    std::function<std::string(const std::string&)> otherwise;
    std::vector<std::string> messages;
    int questions = 0, aborted = 0, clears = 0;
    int interface_bits = 0, device_bits = 0;  // of the capabilities
    // The question of this number is not answered; instead `fault` or, once the request is given
    // up, `late` bytes.
    int hang = 0;
    Fault fault = Fault::timeout;
    Bytes late;
    uint8_t abort_status = 1, abort_check_status = 1;
    int pending_checks = 0;
    int tag_offset = 0, status_tag_offset = 0;
    uint8_t status = 0;
    bool endless = false;  // never says that a message ends

    explicit FakeTmc(bool interrupt = false) {
        port->name_ = "drude HEAD-1 (usbtmc:1209:5e11:H1)";
        port->serial_ = "H1";
        port->vendor_ = 0x1209;
        port->product_ = 0x5E11;
        port->packet_sizes_ = {{0x02, 512}, {0x81, 512}};
        if (interrupt) port->packet_sizes_[0x83] = 8;
        port->on_write = [this](uint8_t, const Bytes& bytes) { receive(bytes); };
        port->on_control_in = [this](const ControlRequest& request, uint16_t) {
            return control(request);
        };
    }

  private:
    void receive(const Bytes& bytes) {
        ASSERT_GE(bytes.size(), 12u);
        ASSERT_EQ(bytes.size() % 4, 0u);
        ASSERT_NE(bytes[1], 0);
        ASSERT_EQ(bytes[2], static_cast<uint8_t>(~bytes[1]));
        const size_t size =
            bytes[4] | (static_cast<size_t>(bytes[5]) << 8) | (static_cast<size_t>(bytes[6]) << 16);
        if (bytes[0] == 1) {
            ASSERT_LE(12 + size, bytes.size());
            message_.append(bytes.begin() + 12, bytes.begin() + 12 + static_cast<int>(size));
            if ((bytes[8] & 1) != 0) finish();
            return;
        }
        ASSERT_EQ(bytes[0], 2);
        tag_ = bytes[1];
        waiting_ = true;
        if (hung_) {
            if (fault != Fault::timeout) port->fail(0x81, fault);
            return;
        }
        if (!answer_.empty() || endless) send(size, (bytes[8] & 2) != 0 ? bytes[9] : -1);
    }
    void finish() {
        std::string text = message_;
        message_.clear();
        messages.push_back(text);
        while (!text.empty() && text.back() == '\n') text.pop_back();
        hung_ = false;
        answer_.clear();
        if (text.empty() || text.find('?') == std::string::npos) return;
        hung_ = ++questions == hang;
        if (hung_) return;
        const auto found = answers.find(text);
        if (found != answers.end()) {
            answer_ = found->second;
        } else if (otherwise) {
            answer_ = otherwise(text);
        }
    }
    void send(size_t most, int terminator) {
        size_t size = std::min(most, answer_.size());
        const size_t end =
            terminator < 0 ? std::string::npos : answer_.find(static_cast<char>(terminator));
        const bool terminated = end != std::string::npos && end < size;
        if (terminated) size = end + 1;
        Bytes transfer(12);
        const uint8_t tag = static_cast<uint8_t>(tag_ + tag_offset);
        const bool last = size == answer_.size() && !endless;
        transfer[0] = 2;
        transfer[1] = tag;
        transfer[2] = static_cast<uint8_t>(~tag);
        for (size_t byte = 0; byte < 4; ++byte) {
            transfer[4 + byte] = static_cast<uint8_t>((size >> (8 * byte)) & 0xFF);
        }
        transfer[8] = static_cast<uint8_t>((last ? 1 : 0) | (terminated ? 2 : 0));
        transfer.insert(transfer.end(), answer_.begin(),
                        answer_.begin() + static_cast<std::ptrdiff_t>(size));
        transfer.resize((transfer.size() + 3) / 4 * 4);
        answer_.erase(0, size);
        waiting_ = false;
        port->answer(0x81, transfer, true);
    }
    Bytes control(const ControlRequest& request) {
        switch (request.request) {
            case 1:
            case 3: {
                EXPECT_EQ(request.request_type, 0xA2);
                EXPECT_EQ(request.index, request.request == 1 ? 0x02 : 0x81);
                if (request.request == 1) return {1, static_cast<uint8_t>(request.value)};
                EXPECT_EQ(request.value, tag_);
                ++aborted;
                if (!waiting_) return {0x81, 0};
                waiting_ = false;
                hung_ = false;
                if (!late.empty() || abort_status == 1) port->answer(0x81, late, true);
                late.clear();
                return {abort_status, tag_};
            }
            case 2:
                return {1, 0, 0, 0, 0, 0, 0, 0};
            case 4: {
                if (pending_checks > 0) {
                    --pending_checks;
                    port->answer(0x81, Bytes(100, 0x77));
                    return {2, 1, 0, 0, 0, 0, 0, 0};
                }
                const uint8_t result = abort_check_status;
                abort_check_status = 1;
                return {result, 0, 0, 0, 0, 0, 0, 0};
            }
            case 5:
                EXPECT_EQ(request.request_type, 0xA1);
                ++clears;
                waiting_ = hung_ = false;
                answer_.clear();
                message_.clear();
                return {1};
            case 6:
                return {1, 0};
            case 7: {
                Bytes bytes(24);
                bytes[0] = 1;
                bytes[3] = 1;
                bytes[4] = static_cast<uint8_t>(interface_bits);
                bytes[5] = static_cast<uint8_t>(device_bits);
                bytes[13] = 1;
                bytes[14] = 4;
                bytes[15] = 8;
                return bytes;
            }
            case 128: {
                const uint8_t tag = static_cast<uint8_t>(request.value + status_tag_offset);
                if (port->packet_sizes_.count(0x83) == 0) return {1, tag, status};
                port->answer(0x83, {static_cast<uint8_t>(0x80 | tag), status});
                return {1, tag, 0};
            }
            default:
                ADD_FAILURE() << "request " << int{request.request};
                return {0x80};
        }
    }

    std::string message_, answer_;
    uint8_t tag_ = 0;
    bool waiting_ = false, hung_ = false;
};

}  // namespace drude
