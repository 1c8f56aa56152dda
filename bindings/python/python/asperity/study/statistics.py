"""Estimates with their 95 % intervals, and coefficients of agreement."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Callable, NamedTuple, Tuple

import numpy as np
from numpy.typing import NDArray

from ._extra import stats

_Array = NDArray[np.float64]


class Estimate(NamedTuple):
    """A number, the ends of its 95 % interval, and the participants that it rests on.

    NaN stands where there is too little to tell.
    """

    value: float
    low: float
    high: float
    n: int


NOTHING = Estimate(np.nan, np.nan, np.nan, 0)


@dataclass(frozen=True)
class Options:
    """Choices of an analysis.

    Attributes
    ----------
    guard : float, default 10
        Points of 100 by which anchors must differ before a place between them means anything.
    resamples : int, default 2000
        Resamples of a bootstrap.
    seed : int, default 1
        Every interval starts a NumPy Generator from it, so that none depends on another.
    """

    guard: float = 10.0
    resamples: int = 2000
    seed: int = 1


def _finite(values: Any) -> _Array:
    kept: _Array = np.asarray(values, dtype=float)
    kept = kept[np.isfinite(kept)]
    return kept


def mean_interval(values: Any) -> Estimate:
    """The mean of one value a participant with its t interval (Student 1908); NaN is left out."""
    kept = _finite(values)
    n = len(kept)
    if n == 0:
        return NOTHING
    half = stats.t.ppf(0.975, n - 1) * kept.std(ddof=1) / np.sqrt(n) if n > 1 else np.nan
    mean = float(kept.mean())
    return Estimate(mean, float(mean - half), float(mean + half), n)


def bootstrap(
    statistic: Callable[[NDArray[np.intp]], _Array], n: int, options: Options
) -> Tuple[float, float]:
    """The percentile interval over n participants (Efron & Tibshirani 1993, chapter 13).

    Participants are drawn, never trials, since one person's ratings are not independent. The
    statistic takes indices of shape (resamples, n) and gives values of shape (resamples,). One
    participant tells nothing about others: the interval is NaN.
    """
    if n < 2:
        return np.nan, np.nan
    draws = np.random.default_rng(options.seed).integers(n, size=(options.resamples, n))
    values = _finite(statistic(draws))
    if len(values) == 0:
        return np.nan, np.nan
    low, high = np.percentile(values, [2.5, 97.5])
    return float(low), float(high)


def ratio(over: Any, under: Any, options: Options) -> Estimate:
    """A share of all that participants did: counts of shape (participants,), bootstrapped."""
    over, under = np.asarray(over, dtype=float), np.asarray(under, dtype=float)
    over, under = over[under > 0], under[under > 0]
    if len(under) == 0:
        return NOTHING
    interval = bootstrap(lambda draw: over[draw].sum(1) / under[draw].sum(1), len(under), options)
    return Estimate(float(over.sum() / under.sum()), *interval, len(under))


def median(values: Any, options: Options) -> Estimate:
    """The median of one value a participant, bootstrapped; NaN is left out."""
    kept = _finite(values)
    if len(kept) == 0:
        return NOTHING
    interval = bootstrap(lambda draw: np.median(kept[draw], axis=1), len(kept), options)
    return Estimate(float(np.median(kept)), *interval, len(kept))


def kendall_w(values: Any) -> Tuple[float, float]:
    """Kendall's coefficient of concordance W and its p value (Kendall & Babington Smith 1939).

    Of values of shape (m participants, n textures) without gaps, W = 12 S / (m² (n³ − n) − m T):
    S is the sum of squared deviations of the rank sums, T the sum of t³ − t over each participant's
    groups of t tied ranks. m (n − 1) W is near χ² with n − 1 degrees of freedom where participants
    order at random. NaN for fewer than 2 × 2, or where all is tied.
    """
    values = np.asarray(values, dtype=float)
    m, n = values.shape if values.ndim == 2 else (0, 0)
    if m < 2 or n < 2:
        return np.nan, np.nan
    ranks = stats.rankdata(values, axis=1)
    sums = ranks.sum(0)
    ties = [np.unique(row, return_counts=True)[1] for row in ranks]
    tied = sum(float((t**3 - t).sum()) for t in ties)
    under = m**2 * (n**3 - n) - m * tied
    if under <= 0:
        return np.nan, np.nan
    w = float(12 * ((sums - sums.mean()) ** 2).sum() / under)
    return w, float(stats.chi2.sf(m * (n - 1) * w, n - 1))


def cronbach_alpha(values: Any) -> Estimate:
    """Cronbach's alpha (Cronbach 1951) with the interval of Feldt (1965).

    Of answers of shape (participants, items) without gaps, reversed items turned round.
    """
    values = np.asarray(values, dtype=float)
    n, k = values.shape
    total = values.sum(1).var(ddof=1) if n > 1 else 0.0
    if k < 2 or total <= 0:
        return NOTHING._replace(n=n)
    alpha = k / (k - 1) * (1 - values.var(axis=0, ddof=1).sum() / total)
    low, high = 1 - (1 - alpha) * stats.f.ppf([0.975, 0.025], n - 1, (n - 1) * (k - 1))
    return Estimate(float(alpha), float(low), float(high), n)
