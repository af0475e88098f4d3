#!/usr/bin/env python3
"""Drivers that others wrote against the virtual instruments, and against what drude reads from them.

To be run by usb-bench, with the program instrument-client and URIs that the bench has:

    usb-bench --device ooi:USB4C00001 --device usbtmc:TMC0001 -- python3 \\
        tests/oracles/usb_drivers.py build/instrument-client \\
        ooi:USB4C00001 usbtmc:1209:5e11:TMC0001

python-seabreeze (its pyusb back end) must find the same serial number, wavelengths and counts as
drude, and python-usbtmc the same identity, Psi and Delta. Needs the packages seabreeze, pyusb and
python-usbtmc: in a virtual environment outside the repository, `pip install seabreeze pyusb
python-usbtmc`, and its python instead of python3. What is not there is skipped, and said so. Exit
status 1 where a driver disagrees.

The bench must be without noise, so that two exposures of the same light are equal.
"""
import importlib.metadata
import subprocess
import sys

failures = 0


def check(what, agrees, detail):
    global failures
    failures += not agrees
    print(f"{'PASS' if agrees else 'FAIL'} {what}: {detail}", flush=True)


def ask_drude(program, *arguments):
    """Lines that instrument-client prints."""
    result = subprocess.run([program, *arguments], capture_output=True, text=True, timeout=120)
    if result.returncode != 0:
        print(f"FAIL {' '.join(arguments)}: {result.stderr.strip()}")
        sys.exit(1)
    return result.stdout.splitlines()


def say_versions(*packages):
    print("with " + ", ".join(f"{name} {importlib.metadata.version(name)}" for name in packages))


def judge_spectrometer(program, uri):
    try:
        import seabreeze
        seabreeze.use("pyseabreeze")
        from seabreeze.spectrometers import Spectrometer, list_devices
        import usb  # noqa: F401  (what that back end talks through)
    except ImportError as error:
        print(f"SKIP seabreeze: {error}; pip install seabreeze pyusb")
        return
    say_versions("seabreeze", "pyusb")
    lines = ask_drude(program, "spectrometer", uri, "0.01")
    # "SERIAL N pixels from FIRST to LAST nm", then the counts.
    serial, pixels, _, _, first, _, last, _ = lines[0].split()
    ours = [int(line) for line in lines[1:]]
    found = [device.serial_number for device in list_devices()]
    check("seabreeze: serial number", serial in found, f"{found}, drude {serial}")
    if serial not in found:
        return
    spectrometer = Spectrometer.from_serial_number(serial)
    spectrometer.integration_time_micros(10000)
    for _ in range(2):  # may have begun before that
        spectrometer.intensities()
    theirs = [int(value) for value in spectrometer.intensities()]
    wavelengths = [float(value) for value in spectrometer.wavelengths()]
    spectrometer.close()
    check("seabreeze: pixels", len(theirs) == len(ours) == int(pixels),
          f"{len(theirs)}, drude {len(ours)}")
    worst = max(abs(wavelengths[0] - float(first)), abs(wavelengths[-1] - float(last)))
    check("seabreeze: wavelengths", worst < 1e-9,
          f"{wavelengths[0]} to {wavelengths[-1]} nm, {worst:.1e} nm from drude's")
    different = sum(a != b for a, b in zip(theirs, ours))
    check("seabreeze: counts", different == 0 and max(theirs) > min(theirs),
          f"{different} of {len(ours)} differ, from {min(theirs)} to {max(theirs)}")


def judge_head(program, uri):
    try:
        import usbtmc
    except ImportError as error:
        print(f"SKIP usbtmc: {error}; pip install python-usbtmc pyusb")
        return
    say_versions("python-usbtmc", "pyusb")
    identity = ask_drude(program, "head", uri, "70")[0]
    serial = uri.split(":")[-1]
    instruments = [device for device in usbtmc.list_devices() if device.serial_number == serial]
    check("usbtmc: finds the head", len(instruments) == 1, f"{len(instruments)} of serial {serial}")
    if len(instruments) != 1:
        return
    instrument = usbtmc.Instrument(instruments[0])
    answer = instrument.ask("*IDN?").strip()
    # drude prints the four fields with a space after each comma.
    fields = [[field.strip() for field in text.split(",")] for text in (answer, identity)]
    check("usbtmc: *IDN?", fields[0] == fields[1], f"'{answer}', drude '{identity}'")
    # The whole table in one answer of several packets, as numbers.
    instrument.write("SOUR:ANG 70")
    theirs = [float(number) for number in instrument.ask("MEAS:PSID?").split(",")]
    instrument.close()
    ours = [float(number) for line in ask_drude(program, "head", uri, "70")[1:]
            for number in line.split()]
    check("usbtmc: Psi and Delta", theirs == ours and len(ours) > 100, f"{len(theirs)} numbers")


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    for uri in sys.argv[2:]:
        (judge_head if uri.startswith("usbtmc:") else judge_spectrometer)(sys.argv[1], uri)
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
