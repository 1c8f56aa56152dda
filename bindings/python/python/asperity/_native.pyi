import os
from typing import (
    Any,
    Callable,
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
from typing_extensions import disjoint_base

from ._records import (
    Attributes,
    Exported,
    Friction,
    Gains,
    Grid,
    Provenance,
    Sizes,
    Taps,
    Wall,
)
from ._rendered import Counters, Flags, Rendered
from ._solids import Box, Plane, Sphere

__all__ = [
    "Author",
    "Library",
    "Output",
    "Renderer",
    "Scene",
    "Texture",
    "__version__",
    "blend",
    "build",
    "builtin",
    "compile",
    "compose",
    "diff",
    "encode",
    "export",
    "import_effect",
    "import_hatt",
    "import_model",
    "import_recording",
    "import_surface",
    "load",
    "merge",
    "pack",
    "plot",
]

_Path = Union[str, "os.PathLike[str]"]
_Fidelity = Union[int, str]
_Preview = Union[bool, int]
_Solid = Union[Plane, Sphere, Box]
_Progress = Callable[[int, int], object]

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
    def edit(
        self,
        *,
        rougher: float = 0.0,
        sharper: float = 0.0,
        harder: float = 0.0,
        slipperier: float = 0.0,
        prompt: Optional[str] = None,
        name: Optional[str] = None,
        preview: _Preview = True,
        author: Optional[Author] = None,
    ) -> Texture: ...
    def undo(
        self,
        *,
        name: Optional[str] = None,
        preview: _Preview = True,
        author: Optional[Author] = None,
    ) -> Texture: ...
    def rename(self, name: str) -> Texture: ...
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

@disjoint_base
class Library:
    @property
    def names(self) -> List[str]: ...
    @property
    def report(self) -> Optional[Dict[str, Any]]: ...
    def extract(self, texture: Union[int, str]) -> Texture: ...
    def rename(self, texture: Union[int, str], name: str) -> Library: ...
    def split(self, into: int) -> List[Library]: ...
    def to_bytes(self) -> bytes: ...
    def save(self, path: _Path) -> None: ...
    def __len__(self) -> int: ...
    def __contains__(self, name: str, /) -> bool: ...
    def __getitem__(self, texture: Union[int, str], /) -> Texture: ...
    def __iter__(self) -> Iterator[Texture]: ...

@final
class Scene(Library):
    @property
    def surfaces(self) -> List[Dict[str, Any]]: ...

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
        preview: _Preview = True,
    ) -> Texture: ...

@final
class Renderer:
    def __new__(
        cls,
        texture: Union[Texture, Scene],
        *,
        solid: Optional[_Solid] = None,
        seed: int = 0,
        rate: Optional[float] = None,
        fixed_point: bool = False,
        peak_n: float = 3.3,
        slew_n_s: float = 2000.0,
        reach_m: float = 1.0,
        vibration_axis: Literal["tangent", "binormal"] = "tangent",
    ) -> Renderer: ...
    @property
    def rate_hz(self) -> float: ...
    @property
    def fixed_point(self) -> bool: ...
    @property
    def wall(self) -> Optional[Wall]: ...
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
    @property
    def surface(self) -> Optional[int]: ...

def compile(
    prompt: str,
    *,
    seed: int = 0,
    fidelity: _Fidelity = "auto",
    rate: Optional[float] = None,
    preview: _Preview = True,
) -> Texture: ...
def blend(
    a: Texture,
    b: Texture,
    t: float = 0.5,
    *,
    name: Optional[str] = None,
    preview: _Preview = True,
    author: Optional[Author] = None,
) -> Texture: ...
def compose(
    *,
    tap: Texture,
    slide: Texture,
    friction: Optional[Texture] = None,
    name: Optional[str] = None,
    preview: _Preview = True,
    author: Optional[Author] = None,
) -> Texture: ...
def encode(
    texture: Texture,
    part: Optional[Literal["whole", "taps", "slide"]] = None,
    *,
    name: Optional[str] = None,
    preview: _Preview = True,
    author: Optional[Author] = None,
) -> Texture: ...
def builtin() -> Texture: ...
def import_hatt(
    path: _Path,
    *,
    fidelity: _Fidelity = "full",
    complete_taps: bool = False,
    progress: Optional[_Progress] = None,
) -> Union[Texture, List[Texture]]: ...
def import_recording(
    folder: _Path,
    *,
    fidelity: _Fidelity = "auto",
    rate: Optional[float] = None,
    force: bool = False,
    model: Optional[_Path] = None,
    preview: _Preview = True,
    plot: Optional[_Path] = None,
) -> Texture: ...
def import_surface(
    path: _Path,
    *,
    width_mm: Optional[float] = None,
    depth_mm: Optional[float] = None,
    normal: Optional[Literal["gl", "dx"]] = None,
    like: Optional[str] = None,
    tip: Literal["stylus", "fingertip", "needle"] = "stylus",
    name: Optional[str] = None,
    fidelity: _Fidelity = "auto",
    rate: Optional[float] = None,
    author: Optional[Author] = None,
    preview: _Preview = True,
    plot: Optional[_Path] = None,
) -> Texture: ...
def import_effect(
    path: _Path,
    *,
    name: Optional[str] = None,
    speed_mm_s: float = 100.0,
    force_n: float = 1.0,
    full_scale_m_s2: float = 5.0,
    tap_full_scale_m_s2: float = 50.0,
    tap_speed_m_s: float = 0.3,
    mu: float = 0.5,
    fidelity: _Fidelity = "auto",
    rate: Optional[float] = None,
    preview: _Preview = True,
) -> Texture: ...
def import_model(
    path: _Path,
    *,
    fidelity: _Fidelity = "full",
    rate: Optional[float] = None,
    preview: _Preview = True,
) -> Texture: ...
def load(
    origin: Union[_Path, bytes], texture: Union[str, int, None] = None
) -> Union[Texture, Library]: ...
def build(
    manifest: _Path,
    path: Optional[_Path] = None,
    *,
    model: Optional[_Path] = None,
    text_encoder: str = "minilm",
    backend: Literal["portable", "onnxruntime"] = "portable",
    preview: _Preview = True,
    cache: Union[bool, _Path] = True,
    shard: Optional[str] = None,
    locked: bool = False,
    confined: bool = False,
    min_certainty: Optional[Literal["known", "close", "guess"]] = None,
    target: Optional[str] = None,
    share: float = 50.0,
    budget_bytes: Optional[int] = None,
    progress: Optional[_Progress] = None,
) -> Library: ...
def merge(
    libraries: Iterable[Union[Library, Texture]], path: Optional[_Path] = None
) -> Library: ...
def diff(old: Union[Library, Texture], new: Union[Library, Texture]) -> Dict[str, Any]: ...
def export(
    texture: Union[Texture, Library],
    to: Literal["c-array", "rust", "hjif", "hmpg", "ahap", "haptic", "gltf", "wav", "csv"],
    path: Optional[_Path] = None,
    *,
    speed_mm_s: Optional[float] = None,
    force_n: Optional[float] = None,
    time_s: Optional[float] = None,
    taps: bool = False,
    full_scale_m_s2: Optional[float] = None,
    tap_full_scale_m_s2: Optional[float] = None,
    seed: int = 0,
    rate: Optional[float] = None,
    size: int = 256,
    symbol: Optional[str] = None,
    keep_preview: bool = False,
) -> Exported: ...
def pack(textures: Iterable[Texture], path: Optional[_Path] = None) -> Library: ...
@overload
def plot(texture: Texture, path: None = None) -> bytes: ...
@overload
def plot(texture: Texture, path: _Path) -> None: ...
