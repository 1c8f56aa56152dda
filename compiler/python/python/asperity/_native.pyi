import os
from typing import (
    Any,
    Dict,
    Iterable,
    Iterator,
    List,
    Literal,
    Optional,
    Tuple,
    Union,
    final,
    overload,
)

from numpy.typing import ArrayLike

from ._records import (
    Attributes,
    Counters,
    Flags,
    Friction,
    Gains,
    Grid,
    Provenance,
    Rendered,
    Sizes,
    Taps,
    Wall,
)

__all__ = [
    "Author",
    "Library",
    "Output",
    "Renderer",
    "Texture",
    "__version__",
    "builtin",
    "compile",
    "import_hatt",
    "import_model",
    "load",
    "pack",
    "plot",
]

_Path = Union[str, "os.PathLike[str]"]
_Fidelity = Union[int, str]

__version__: str

@final
class Texture:
    def __new__(cls, data: bytes) -> Texture: ...
    @property
    def name(self) -> str: ...
    @property
    def prompt(self) -> Optional[str]: ...
    @property
    def format_version(self) -> int: ...
    @property
    def grid(self) -> Grid: ...
    @property
    def taps(self) -> Taps: ...
    @property
    def friction(self) -> Friction: ...
    @property
    def wall(self) -> Wall: ...
    @property
    def gains(self) -> Gains: ...
    @property
    def attributes(self) -> Attributes: ...
    @property
    def sizes(self) -> Sizes: ...
    @property
    def provenance(self) -> Provenance: ...
    @property
    def report(self) -> Optional[Dict[str, Any]]: ...
    @property
    def preview_png(self) -> Optional[bytes]: ...
    def to_dict(self) -> Dict[str, Any]: ...
    def to_bytes(self) -> bytes: ...
    def save(self, path: _Path) -> None: ...
    @overload
    def plot(self, path: None = None) -> bytes: ...
    @overload
    def plot(self, path: _Path) -> None: ...
    def _repr_png_(self) -> bytes: ...
    def __bytes__(self) -> bytes: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __ne__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __getnewargs__(self) -> Tuple[bytes]: ...

@final
class Library:
    @property
    def names(self) -> List[str]: ...
    @property
    def surfaces(self) -> List[Dict[str, Any]]: ...
    def __len__(self) -> int: ...
    def __contains__(self, name: str, /) -> bool: ...
    def __getitem__(self, texture: Union[int, str], /) -> Texture: ...
    def __iter__(self) -> Iterator[Texture]: ...

@final
class Author:
    def __new__(
        cls,
        model: Optional[_Path] = None,
        *,
        text_encoder: str = "minilm",
        backend: Literal["portable", "onnxruntime"] = "portable",
    ) -> Author: ...
    def compile(
        self,
        prompt: str,
        *,
        seed: int = 0,
        fidelity: _Fidelity = "auto",
        rate: Optional[float] = None,
        preview: bool = True,
    ) -> Texture: ...

@final
class Renderer:
    def __new__(
        cls,
        texture: Texture,
        *,
        seed: int = 0,
        rate: Optional[float] = None,
        fixed_point: bool = False,
        peak_n: float = 3.3,
        slew_n_s: float = 2000.0,
        vibration_axis: Literal["tangent", "binormal"] = "tangent",
    ) -> Renderer: ...
    @property
    def rate_hz(self) -> float: ...
    @property
    def fixed_point(self) -> bool: ...
    @property
    def wall(self) -> Wall: ...
    @property
    def counters(self) -> Counters: ...
    def tick(self, position_m: ArrayLike, elapsed_ticks: int = 1) -> Output: ...
    def render(
        self, positions_m: ArrayLike, elapsed_ticks: Optional[ArrayLike] = None
    ) -> Rendered: ...
    def reset(self, seed: Optional[int] = None) -> None: ...

@final
class Output:
    @property
    def force_n(self) -> Tuple[float, float, float]: ...
    @property
    def depth_m(self) -> float: ...
    @property
    def speed_mm_s(self) -> float: ...
    @property
    def normal_force_n(self) -> float: ...
    @property
    def vib_m_s2(self) -> float: ...
    @property
    def tap_n(self) -> float: ...
    @property
    def friction_n(self) -> float: ...
    @property
    def flags(self) -> Flags: ...

def compile(
    prompt: str,
    *,
    seed: int = 0,
    fidelity: _Fidelity = "auto",
    rate: Optional[float] = None,
    preview: bool = True,
) -> Texture: ...
def builtin() -> Texture: ...
def import_hatt(
    path: _Path, *, fidelity: _Fidelity = "full", complete_taps: bool = False
) -> Union[Texture, List[Texture]]: ...
def import_model(
    path: _Path,
    *,
    fidelity: _Fidelity = "full",
    rate: Optional[float] = None,
    preview: bool = True,
) -> Texture: ...
def load(
    origin: Union[_Path, bytes], texture: Union[str, int, None] = None
) -> Union[Texture, Library]: ...
def pack(textures: Iterable[Texture], path: Optional[_Path] = None) -> Library: ...
@overload
def plot(texture: Texture, path: None = None) -> bytes: ...
@overload
def plot(texture: Texture, path: _Path) -> None: ...
