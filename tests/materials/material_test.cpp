#include "materials/material.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <functional>
#include <limits>

#include "base/error.h"
#include "base/files.h"

namespace drude {
namespace {

Material full_material() {
    Material material;
    material.name = "sample \"7\"\n\\ \xC3\xA4";
    OpticalConstants& bulk = material.substrate;
    bulk.name = "bulk";
    bulk.material = "Cu";
    bulk.citation = "own measurement";
    bulk.kind = "fitted";
    bulk.wavelength_nm = {380, 380.1, 1000.0 / 3};
    std::sort(bulk.wavelength_nm.begin(), bulk.wavelength_nm.end());
    bulk.n = {0.1, std::nextafter(1.0, 2.0), 5e-324};
    bulk.k = {0, -0.0, 1e6};
    bulk.sigma_n = {1e-3, 2e-17, 0};
    bulk.sigma_k = {1.0 / 3, 2.0 / 3, 1e-300};
    bulk.policy = RangePolicy::error;
    for (const char* set : {"Al2O3-Boidin", "Si-Aspnes"}) {
        FilmLayer layer;
        layer.constants = published_set(set);
        layer.thickness_nm = 3000.0 / 7;
        if (material.layers.empty()) layer.thickness_spread_nm = 100.0 / 7;
        material.layers.push_back(layer);
    }
    material.lobe = Lobe::gaussian;
    material.masking = Masking::v_groove;
    material.beta = 0.1 + 0.2;
    material.provenance = {
        "m.csv", std::string(64, 'a'), "drude fit m.csv", "0.1.0", {"first", "second \t one"}};
    return material;
}

void expect_same_bits(const std::vector<double>& a, const std::vector<double>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(std::memcmp(&a[i], &b[i], sizeof(double)), 0) << a[i] << " and " << b[i];
    }
}

void expect_same(const OpticalConstants& a, const OpticalConstants& b) {
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.material, b.material);
    EXPECT_EQ(a.citation, b.citation);
    EXPECT_EQ(a.kind, b.kind);
    EXPECT_EQ(a.policy, b.policy);
    expect_same_bits(a.wavelength_nm, b.wavelength_nm);
    expect_same_bits(a.n, b.n);
    expect_same_bits(a.k, b.k);
    expect_same_bits(a.sigma_n, b.sigma_n);
    expect_same_bits(a.sigma_k, b.sigma_k);
}

void expect_same(const Material& a, const Material& b) {
    EXPECT_EQ(a.name, b.name);
    expect_same(a.substrate, b.substrate);
    ASSERT_EQ(a.layers.size(), b.layers.size());
    for (size_t i = 0; i < a.layers.size(); ++i) {
        expect_same(a.layers[i].constants, b.layers[i].constants);
        expect_same_bits({a.layers[i].thickness_nm, a.layers[i].thickness_spread_nm},
                         {b.layers[i].thickness_nm, b.layers[i].thickness_spread_nm});
    }
    EXPECT_EQ(a.lobe, b.lobe);
    EXPECT_EQ(a.masking, b.masking);
    expect_same_bits({a.beta}, {b.beta});
    EXPECT_EQ(a.provenance.measurement, b.provenance.measurement);
    EXPECT_EQ(a.provenance.measurement_sha256, b.provenance.measurement_sha256);
    EXPECT_EQ(a.provenance.command, b.provenance.command);
    EXPECT_EQ(a.provenance.version, b.provenance.version);
    EXPECT_EQ(a.provenance.warnings, b.provenance.warnings);
}

// The message of the Error (user) that reading `json` as "cu.json" must throw.
std::string message_of(const std::string& json) {
    try {
        parse_material(json, "cu.json");
    } catch (const Error& error) {
        EXPECT_EQ(error.cause(), Cause::user) << error.message();
        EXPECT_EQ(error.message().find("cu.json:"), 0U) << error.message();
        EXPECT_EQ(error.message().find("json.exception"), std::string::npos) << error.message();
        return error.message();
    } catch (const std::exception& exception) {
        ADD_FAILURE() << json << " let escape " << exception.what();
        return {};
    }
    ADD_FAILURE() << "nothing was thrown for " << json;
    return {};
}

void expect_message(const std::string& json, const std::vector<std::string>& parts) {
    const std::string message = message_of(json);
    for (const std::string& part : parts) {
        EXPECT_NE(message.find(part), std::string::npos) << message << "\nlacks " << part;
    }
}

// A valid record with `members` after its substrate, which opens line 3.
std::string record(const std::string& members) {
    return "{\"format\": \"drude-material/1\",\n \"name\": \"a\",\n \"substrate\": {\"set\": "
           "\"Cu\"}" +
           members + "}";
}

TEST(Material, RecordComesBackBitForBit) {
    const Material material = full_material();
    const std::string json = format_material(material);
    expect_same(parse_material(json, "cu.json"), material);
    EXPECT_EQ(format_material(parse_material(json, "cu.json")), json);
    for (const OpticalConstants& set : published_sets()) {
        const Material bare = material_from_set(set);
        expect_same(parse_material(format_material(bare), "cu.json"), bare);
    }
}

TEST(Material, GoesThroughAFile) {
    const std::string path = testing::TempDir() + "drude_material_test.json";
    write_material(path, full_material());
    expect_same(read_material(path), full_material());
    expect_same(find_material(path), full_material());
    std::filesystem::remove(path);
    EXPECT_THROW(read_material(path), Error);
}

TEST(Material, IsFoundByNameOrFile) {
    expect_same(find_material("Cu"), material_from_set(published_set("Cu-McPeak")));
    EXPECT_EQ(find_material("Ag-Johnson").beta, 0);
    EXPECT_EQ(find_material("Ag-Johnson").name, "Ag-Johnson");
    EXPECT_TRUE(find_material("Ag-Johnson").layers.empty());
    for (const char* missing : {"absent.json", "./Cu", "kryptonite"}) {
        try {
            find_material(missing);
            ADD_FAILURE() << missing;
        } catch (const Error& error) {
            EXPECT_EQ(error.cause(), Cause::user);
            EXPECT_NE(error.message().find(missing), std::string::npos) << error.message();
        }
    }
}

TEST(Material, ShortRecordsGetDefaults) {
    const Material bare = parse_material(record(""), "cu.json");
    expect_same(bare.substrate, published_set("Cu-McPeak"));
    EXPECT_EQ(bare.lobe, Lobe::trowbridge_reitz);
    EXPECT_EQ(bare.masking, Masking::smith);
    EXPECT_EQ(bare.beta, 0);
    const Material film = parse_material(
        record(", \"lobe\": \"gaussian\", \"layers\": [{\"set\": \"Al2O3\", \"thickness_nm\": 3}, "
               "{\"wavelength_nm\": [500], \"n\": [2], \"k\": [0], \"thickness_nm\": 0}]"),
        "cu.json");
    EXPECT_EQ(film.masking, Masking::v_groove) << "the only one this lobe has";
    EXPECT_EQ(film.layers.at(0).constants.name, "Al2O3-Malitson-o");
    EXPECT_EQ(film.layers.at(0).thickness_nm, 3);
    EXPECT_EQ(film.layers.at(1).constants.n, std::vector<double>{2});
    const Material strict = parse_material(
        "{\"format\": \"drude-material/1\", \"name\": \"a\", \"substrate\": {\"set\": "
        "\"Ag-Johnson\", "
        "\"range_policy\": \"error\"}}",
        "cu.json");
    EXPECT_EQ(strict.substrate.policy, RangePolicy::error);
}

TEST(Material, SyntaxErrorsHaveTheirPlace) {
    expect_message("", {"cu.json:1:1: ", "the file ends here, expected a JSON value"});
    expect_message("{\n  \"name\": \"a\"", {"cu.json:2:14: ", "the file ends here", "',' or '}'"});
    expect_message("{\"a\": [1, 2\n, ]}", {"cu.json:2:3: ", "found ']'", "another value"});
    expect_message("{\"a\": 1,\n}", {"cu.json:2:1: ", "found '}'", "another key"});
    expect_message("{\"a\" 1}", {"cu.json:1:6: ", "found '1'", "expected ':'"});
    expect_message("{\"a\": }", {"cu.json:1:7: ", "found '}'", "expected a value"});
    expect_message("{\"a\": 1 \"b\": 2}", {"cu.json:1:9: ", "expected ',' or '}'"});
    expect_message("{a: 1}", {"cu.json:1:2: ", "found 'a'", "a key in double quotes"});
    expect_message("{\"a\": [1,,2]}", {"cu.json:1:10: ", "found ','"});
    expect_message("{\"a\": 1}\n x", {"cu.json:2:2: ", "found 'x'", "the end of the file"});
    expect_message("{\n\"a\": nul}", {"cu.json:2:6: "});
    expect_message("{\n\"a\": 01}", {"cu.json:2:7: "});
    expect_message("{\"a\": NaN}", {"cu.json:1:7: ", "found 'N"});
    expect_message("{\"a\": \"b\n\"}", {"cu.json:1:7: ", "a string that has no end"});
    expect_message("{\"a\": \"b", {"cu.json:1:7: ", "a string that has no end"});
    expect_message("{\"a\": \"\xFF\"}", {"cu.json:1:7: ", "UTF-8"});
    expect_message("{\"a\": \n1e999}", {"cu.json:2:1: ", "found 1e999", "too large"});
    expect_message("{\"beta\": 1,\n \"beta\": 2}", {"cu.json:2:2: ", "'beta'", "second time"});
}

TEST(Material, GarbageNeverCrashes) {
    const size_t deep = 1000000;
    expect_message(std::string(deep, '['), {"cu.json:1:65: ", "deeper than 64"});
    std::string objects;
    for (size_t i = 0; i < deep; ++i) objects += "{\"a\":";
    expect_message(objects, {"cu.json:1:", "deeper than 64"});
    message_of(std::string(deep, ']'));
    message_of(std::string(1000, '\0'));
    message_of("\xEF\xBB\xBF");
    message_of("\xEF\xBB");
    for (const char* json : {"null", "3", "\"x\"", "[]", "true", "{}", "[{}]"}) message_of(json);
    // Every beginning of a record is refused, every single wrong byte refused or read.
    const std::string good = record(", \"beta\": 0.25, \"layers\": []");
    ASSERT_NO_THROW(parse_material(good, "cu.json"));
    for (size_t i = 0; i < good.size(); ++i) message_of(good.substr(0, i));
    for (size_t i = 0; i < good.size(); ++i) {
        for (const char wrong : {'\0', '"', '{', ']', ',', '\\', '-', '\x80', 'e'}) {
            std::string bad = good;
            bad[i] = wrong;
            try {
                parse_material(bad, "cu.json");
            } catch (const Error& error) {
                EXPECT_EQ(error.cause(), Cause::user);
                EXPECT_EQ(error.message().find("cu.json:"), 0U) << error.message();
            }
        }
    }
}

TEST(Material, ManyKeysTakeNoTime) {
    std::string json = "{\"format\": \"drude-material/1\"";
    for (int i = 0; i < 200000; ++i) json += ",\"" + std::to_string(i) + "\":0";
    expect_message(json + "}", {"unknown key '0'"});
}

TEST(Material, UnknownAndMissingKeysAreNamed) {
    expect_message(record(",\n \"bta\": 0"), {"cu.json:4:2: ", "'bta'", "did you mean 'beta'?"});
    expect_message(record(", \"provenance\": {\"comand\": \"\"}"),
                   {"cu.json:3:", "'provenance'", "did you mean 'command'?"});
    expect_message(record(", \"layers\": [{\"set\": \"Al2O3\", \"thickness\": 3}]"),
                   {"'layers[0]'", "'thickness'", "thickness_nm"});
    expect_message(record(", \"layers\": [{\"set\": \"Al2O3\"}]"),
                   {"'layers[0]'", "no key 'thickness_nm'"});
    expect_message("{\"name\": \"a\"}", {"cu.json:1:1: ", "no key 'format'"});
    expect_message("{\"format\": \"drude-material/2\", \"new\": 1}",
                   {"cu.json:1:12: ", "'drude-material/2'", "expected 'drude-material/1'"});
    expect_message("{\"format\": \"drude-material/1\"}", {"no key 'name'"});
    expect_message("{\"format\": \"drude-material/1\", \"name\": \"a\"}", {"no key 'substrate'"});
    const std::string start = "{\"format\": \"drude-material/1\", \"name\": \"a\", \"substrate\": ";
    expect_message(start + "{}}", {"'substrate'", "no key 'wavelength_nm'"});
    expect_message(start + "{\"wavelength_nm\": [1], \"n\": [1]}}", {"'substrate'", "no key 'k'"});
    expect_message(start + "{\"set\": \"Cu\", \"n\": [1]}}", {"'substrate'", "unknown key 'n'"});
    expect_message(start + "{\"set\": \"Cu-Jonson\"}}",
                   {"cu.json:1:66: ", "'substrate.set'", "did you mean 'Cu-Johnson'?"});
}

TEST(Material, WrongTypesAreNamed) {
    expect_message("[]", {"cu.json:1:1: ", "the record is an array, expected an object"});
    expect_message(record(", \"beta\": \"0\""), {"'beta' is a string, expected a number"});
    expect_message(record(", \"beta\": null"), {"'beta' is null, expected a number"});
    expect_message(record(", \"beta\": true"), {"'beta' is true or false, expected a number"});
    expect_message(record(", \"lobe\": 1"), {"'lobe' is a number, expected a string"});
    expect_message(record(", \"layers\": {}"), {"'layers' is an object, expected an array"});
    expect_message(record(", \"layers\": [1]"), {"'layers[0]' is a number, expected an object"});
    expect_message(record(", \"provenance\": []"), {"'provenance' is an array"});
    expect_message(record(", \"provenance\": {\"warnings\": [\"a\",\n2]}"),
                   {"cu.json:4:1: ", "'provenance.warnings[1]' is a number, expected a string"});
    expect_message(
        "{\"format\": \"drude-material/1\", \"name\": \"a\", \"substrate\":\n"
        "{\"wavelength_nm\": [400, 500], \"n\": [1,\n \"2\"], \"k\": [0, 0]}}",
        {"cu.json:3:2: ", "'substrate.n[1]' is a string, expected a number"});
}

TEST(Material, ValuesOutOfRangeAreNamed) {
    expect_message(record(",\n\"beta\": -0.1"), {"cu.json:4:9: ", "'beta'", "-0.1"});
    expect_message(record(", \"beta\": 1.5708"), {"'beta'", "below pi/2"});
    expect_message(record(",\n\"lobe\": \"becman\""), {"cu.json:4:9: ", "'beckmann'"});
    expect_message(record(",\n\"masking\": \"smit\""), {"cu.json:4:12: ", "'smith'"});
    expect_message(record(", \"lobe\": \"gaussian\",\n\"masking\": \"smith\""),
                   {"cu.json:4:12: ", "no Smith masking"});
    expect_message(record(", \"layers\": [{\"set\": \"Al2O3\", \"thickness_nm\":\n-3}]"),
                   {"cu.json:4:1: ", "'layers[0].thickness_nm' is -3"});
    expect_message(record(", \"layers\": [{\"set\": \"Al2O3\", \"thickness_nm\": 30, "
                          "\"thickness_spread_nm\":\n7}]"),
                   {"cu.json:4:1: ", "'layers[0].thickness_spread_nm' is 7, expected 0 to 6"});
    const std::string start =
        "{\"format\": \"drude-material/1\", \"name\": \"a\", \"substrate\":\n";
    expect_message(start + "{\"wavelength_nm\": [500, 400], \"n\": [1, 2], \"k\": [0, 0]}}",
                   {"cu.json:2:1: ", "500 nm is followed by 400 nm"});
    expect_message(start + "{\"wavelength_nm\": [500], \"n\": [1, 2], \"k\": [0]}}",
                   {"cu.json:2:1: ", "2 values of n for 1 wavelengths"});
    expect_message(start + "{\"wavelength_nm\": [], \"n\": [], \"k\": []}}", {"no rows"});
    expect_message(start + "{\"set\": \"Cu\", \"range_policy\": \"clam\"}}",
                   {"cu.json:2:31: ", "did you mean 'clamp'?"});
}

TEST(Material, CheckRefusesWhatARecordMayNotHold) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<std::function<void(Material&)>> spoilers = {
        [&](Material& m) { m.beta = nan; },
        [](Material& m) { m.beta = -1e-9; },
        [](Material& m) { m.beta = std::acos(0.0); },
        [](Material& m) { m.masking = Masking::smith; },  // with the Gaussian lobe
        [&](Material& m) { m.layers[1].thickness_nm = nan; },
        [](Material& m) { m.layers[1].thickness_nm = -1; },
        [](Material& m) { m.layers[1].constants.n[0] = 0; },
        [](Material& m) { m.substrate.k[0] = -1; },
    };
    EXPECT_NO_THROW(full_material().check());
    for (size_t i = 0; i < spoilers.size(); ++i) {
        Material material = full_material();
        spoilers[i](material);
        EXPECT_THROW(material.check(), Error) << i;
        EXPECT_THROW(format_material(material), Error) << i;
    }
}

}  // namespace
}  // namespace drude
