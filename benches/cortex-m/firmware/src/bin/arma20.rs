//! Order 20 with MA part.
#![no_std]
#![no_main]

asperity_firmware::firmware!(asperity_session::ARMA_20, asperity_session::Arma20);
