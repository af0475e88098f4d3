# n and k taken 5 nm beside their wavelength
# file: materials/optical_constants.cpp
# lines: 1
s/constants\.at(spectrum_first_nm + static_cast<double>(i))/constants.at(spectrum_first_nm + 5 + static_cast<double>(i))/
