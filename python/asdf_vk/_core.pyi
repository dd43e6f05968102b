from typing import Any

import numpy as np
from numpy.typing import NDArray

version: str
commit: str

class Mesh:
    @property
    def vertices(self) -> NDArray[np.float64]: ...
    @property
    def faces(self) -> NDArray[np.int32]: ...
    @property
    def face_count(self) -> int: ...
    @property
    def face_of_triangle(self) -> NDArray[np.int32] | None: ...
    @property
    def unit(self) -> str: ...
    @property
    def objects(self) -> tuple[tuple[int, str], ...]: ...

# This file declares only the public names. All other names are private to the package.
def __getattr__(name: str) -> Any: ...
