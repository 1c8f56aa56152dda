//! Order 20, zero at Nyquist.
#![no_std]
#![no_main]

asperity_firmware::firmware!(asperity_session::NYQUIST_20, Nyquist20);
