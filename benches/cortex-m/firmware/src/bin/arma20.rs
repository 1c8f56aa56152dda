//! Order 20 with MA part.
#![no_std]
#![no_main]

asperity_firmware::firmware!(asperity_session::ARMA_20, Arma20);
