//! Timing of a servo loop.
//!
//! A [`Collector`] drains the records of a loop on another thread into a [`Run`]: for every stage a
//! histogram per interval of time, and the worst ticks. Times are ns.
//!
//! | file | holds |
//! |---|---|
//! | `collect` | aggregation of records into a run |
//! | `run` | a run: its intervals, sums, and corrected histograms |
//! | `percentiles` | the reported percentiles |
//! | `verdict` | the verdict by the rule of thumb and by given limits |
//! | `series` | every tick as a line of CSV |
//! | `worst` | the worst ticks |
//! | `hgrm`, `hlog`, `encoded` | the files of HdrHistogram's own tools |
//! | `compare` | the shift of each percentile, with a bootstrap confidence interval |
//! | `inject` | a controlled delay, to check that it is detected |
//! | `conditions` | the conditions of a run |
//! | `cyclictest` | the same measurement by another program |

mod collect;
mod compare;
mod conditions;
mod cyclictest;
mod encoded;
mod facts;
mod hgrm;
mod hlog;
mod inject;
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
pub use percentiles::{Percentiles, QUANTILES, carries};
pub use run::{Counts, Interval, Run};
pub use series::Series;
pub use verdict::{Limits, Punctuality, Verdict};
pub use worst::{WORST, WorstTick};
