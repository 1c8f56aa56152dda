//! How punctual a servo loop is.
//!
//! A [`Collector`] takes the records of a loop on another thread and makes a [`Run`] of them: for
//! every stage a histogram of each interval of time, and the worst ticks. Times are ns.
//!
//! | file | holds |
//! |---|---|
//! | `collect` | from records to a run |
//! | `run` | a run: its intervals, sums, and corrected histograms |
//! | `percentiles` | which percentiles are reported |
//! | `verdict` | whether a run was punctual, and within stated limits |
//! | `series` | every tick as a line of CSV |
//! | `worst` | the worst ticks |
//! | `hgrm`, `hlog`, `encoded` | the files of HdrHistogram's own tools |
//! | `compare` | the shift of each percentile, with a bootstrap confidence |
//! | `inject` | a controlled delay, to see whether it is found |
//! | `load` | bounded work for the machine meanwhile |
//! | `conditions` | under which conditions a run was made |
//! | `cyclictest` | the same by another program |

mod collect;
mod compare;
mod conditions;
mod cyclictest;
mod encoded;
mod facts;
mod hgrm;
mod hlog;
mod inject;
mod load;
mod percentiles;
mod run;
mod series;
mod verdict;
mod worst;

pub use collect::Collector;
pub use compare::{Shift, compare};
pub use conditions::{Conditions, Machine};
pub use cyclictest::{Cyclictest, CyclictestError, Wakeups};
pub use facts::Facts;
pub use hgrm::percentile_distribution;
pub use hlog::{LogError, is_log, read_log, write_log};
pub use inject::{Delayed, Injection, InjectionError};
pub use load::{Load, Loading};
pub use percentiles::{Percentiles, QUANTILES, carries};
pub use run::{Counts, Interval, Run};
pub use series::Series;
pub use verdict::{Limits, Punctuality, Verdict};
pub use worst::{WORST, WorstTick};
