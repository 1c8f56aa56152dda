//! Order 4, zero at Nyquist.
#![no_std]
#![no_main]

asperity_firmware::firmware!(asperity_session::NYQUIST_4, Nyquist4);
