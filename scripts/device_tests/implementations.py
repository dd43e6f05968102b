"""The Vulkan implementations of this machine, and the environments in which programs run on them."""

from __future__ import annotations

import ctypes
import dataclasses
import itertools
import json
import os
import pathlib
import subprocess

from packages import PackageSources, Unavailable, is_newer

LAYER = "VK_LAYER_KHRONOS_validation"
SUITES = ("vk", "trace", "poisson", "predict", "pipeline", "diagnose", "cli")  # the list of scripts/test-devices
KERNEL_SUITES = ("vk", "trace", "poisson", "predict")
FAKE_SUITES = (*KERNEL_SUITES, "pipeline", "diagnose")
QUICK_SUITES = ("vk", "poisson", "predict")
# Widths of the vectors of lavapipe in bits. A subgroup has one lane per 32 bits.
_LAVAPIPE_VECTOR_BITS = (128, 256, 512)
# Environment variables of the machine that must not affect the tests.
_UNRELATED_VARIABLES = (
    "VK_INSTANCE_LAYERS",
    "VK_LAYER_PATH",
    "VK_ADD_LAYER_PATH",
    "ASDF_VK_VALIDATION",
    "LP_NATIVE_VECTOR_WIDTH",
    "LP_NUM_THREADS",
)


@dataclasses.dataclass(frozen=True)
class Implementation:
    name: str
    title: str
    environment: dict[str, str] = dataclasses.field(default_factory=dict)
    wrapper: tuple[str, ...] = ()  # Program that runs a command on a fake device.
    suites: tuple[str, ...] = SUITES


@dataclasses.dataclass(frozen=True)
class ValidationLayer:
    version: str
    environment: dict[str, str]


@dataclasses.dataclass(frozen=True)
class Surroundings:

    build: pathlib.Path  # The build folder.
    folder: pathlib.Path  # The folder build/devices.

    @property
    def program(self) -> str:
        return str(self.build / "src/asdf-vk")

    def environment(self, *parts: dict[str, str]) -> dict[str, str]:
        """Returns the environment of this process without settings of Vulkan. Programs write files below `folder`."""
        result = dict(os.environ)
        for name in _UNRELATED_VARIABLES:
            result.pop(name, None)
        for name, place in (("TMPDIR", "tmp"), ("XDG_CACHE_HOME", "cache")):
            (self.folder / place).mkdir(parents=True, exist_ok=True)
            result[name] = str(self.folder / place)
        for part in parts:
            result.update(part)
        return result

    def devices(self, environment: dict[str, str]) -> list[dict[str, object]]:
        command = [self.program, "--list-devices", "--json"]
        variables = self.environment(environment)
        done = subprocess.run(command, check=True, capture_output=True, text=True, env=variables)
        devices: list[dict[str, object]] = json.loads(done.stdout)["devices"]
        return devices


def with_driver(manifest: pathlib.Path) -> dict[str, str]:
    return {"VK_DRIVER_FILES": str(manifest), "VK_ICD_FILENAMES": str(manifest)}


def _driver_of(surroundings: Surroundings, name: str, library: pathlib.Path) -> dict[str, str]:
    manifest = surroundings.folder / f"{name}_icd.json"
    icd = {"library_path": str(library), "api_version": "1.3.0"}
    manifest.write_text(json.dumps({"file_format_version": "1.0.0", "ICD": icd}))
    return with_driver(manifest)


def _find(folder: pathlib.Path, name: str) -> pathlib.Path:
    found = sorted(folder.rglob(name))
    if not found:
        raise Unavailable(f"{folder.name} contains no {name}")
    return found[0]


def _is_program(file: pathlib.Path) -> bool:
    return file.is_file() and os.access(file, os.X_OK) and not file.suffix


class Drivers:
    """Finds implementations. `missing` has a reason for each implementation that is not available."""

    def __init__(self, surroundings: Surroundings) -> None:
        self._surroundings = surroundings
        self._sources: PackageSources | None = None
        self._chromium: pathlib.Path | None = None
        self.missing: list[str] = []
        self.layer = ValidationLayer("of the system", {})
        try:
            self._sources = PackageSources(surroundings.folder / "apt")
            package = "chromium-common"
            version = self._sources.newest(package).version
            folder = surroundings.folder / f"{package}_{version}"
            self._sources.unpack({package: version}, folder)
            self.layer = self._newest_layer(folder)
            self._chromium = folder
        except Unavailable as reason:
            self.missing.append(f"SwiftShader and its validation layer: {reason}")

    def all(self) -> list[Implementation]:
        return [
            *self._gpus(),
            *self._lavapipe(),
            *self._swiftshader(),
            *self._newer_mesa(),
            *self._fakes(),
        ]

    def _gpus(self) -> list[Implementation]:
        devices = self._surroundings.devices({})
        if any(device["usable"] and device["kind"] != "CPU" for device in devices):
            return [Implementation("gpu", "GPU of this machine")]
        self.missing.append("GPU: this machine has no usable GPU")
        return []

    def _lavapipe(self) -> list[Implementation]:
        manifests = sorted(pathlib.Path("/usr/share/vulkan/icd.d").glob("lvp_icd*.json"))
        if not manifests:
            self.missing.append("lavapipe: no /usr/share/vulkan/icd.d/lvp_icd*.json")
            return []
        found = []
        for bits in _LAVAPIPE_VECTOR_BITS:
            lanes = bits // 32
            environment = with_driver(manifests[0]) | {"LP_NATIVE_VECTOR_WIDTH": str(bits)}
            title = f"lavapipe, subgroups of {lanes}"
            suites = SUITES if lanes == 8 else KERNEL_SUITES
            found.append(Implementation(f"lavapipe{lanes}", title, environment, (), suites))
        return found

    def _swiftshader(self) -> list[Implementation]:
        if self._chromium is None:
            return []
        library = _find(self._chromium, "libvk_swiftshader.so")
        title = f"SwiftShader of {self._chromium.name.replace('_', ' ')}"
        environment = _driver_of(self._surroundings, "swiftshader", library)
        return [Implementation("swiftshader", title, environment)]

    def _newer_mesa(self) -> list[Implementation]:
        try:
            if self._sources is None:
                raise Unavailable("the package sources cannot be read")
            package = "mesa-vulkan-drivers"
            newest = self._sources.newest(package)
            installed = self._sources.installed_version(package)
            if not is_newer(newest.version, installed):
                raise Unavailable(f"the package sources have {newest.version}, which is installed")
            required = self._sources.required(package, newest)
            if "libc6" in required:
                raise Unavailable(f"{newest.version} needs another libc6")
            folder = self._surroundings.folder / f"mesa_{newest.version}"
            self._sources.unpack(required, folder)
            library = _find(folder, "libvulkan_lvp.so")
        except Unavailable as reason:
            self.missing.append(f"newer Mesa: {reason}")
            return []
        environment = _driver_of(self._surroundings, "newer_mesa", library)
        environment["LD_LIBRARY_PATH"] = str(library.parent)
        return [Implementation("newer-mesa", f"lavapipe of Mesa {newest.version}", environment)]

    def _fakes(self) -> list[Implementation]:
        """Returns the fake devices that the programs of tests/fake_device make from lavapipe."""
        folder = self._surroundings.build / "tests/fake_device"
        wrappers = sorted(file for file in folder.glob("*") if _is_program(file))
        if not wrappers or not list(folder.glob("*.so")):
            self.missing.append(f"fake devices: not built in {folder}")
            return []
        found = []
        for wrapper, lavapipe in itertools.product(wrappers, self._lavapipe()):
            if lavapipe.name != "lavapipe8":
                continue
            title = f"fake device {wrapper.name} on lavapipe"
            name, command = f"fake-{wrapper.name}", (str(wrapper),)
            found.append(Implementation(name, title, lavapipe.environment, command, FAKE_SUITES))
        return found

    def _newest_layer(self, folder: pathlib.Path) -> ValidationLayer:
        """The validation layer in a package without a layer manifest."""
        library = _find(folder, "libVkLayer_khronos_validation.so")
        version = _layer_version(library)
        extensions = {
            "VK_EXT_debug_utils": "2",
            "VK_EXT_validation_features": "6",
            "VK_EXT_layer_settings": "2",
        }
        layer = {
            "name": LAYER,
            "type": "GLOBAL",
            "library_path": str(library),
            "api_version": version,
            "implementation_version": "1",
            "description": "Khronos validation layer",
            "instance_extensions": [
                {"name": name, "spec_version": number} for name, number in extensions.items()
            ],
        }
        manifests = self._surroundings.folder / "layers"
        manifests.mkdir(exist_ok=True)
        (manifests / "VkLayer_khronos_validation.json").write_text(
            json.dumps({"file_format_version": "1.2.0", "layer": layer}))
        return ValidationLayer(version, {"VK_LAYER_PATH": str(manifests)})


class _LayerProperties(ctypes.Structure):
    _fields_ = (
        ("name", ctypes.c_char * 256),
        ("specification", ctypes.c_uint32),
        ("implementation", ctypes.c_uint32),
        ("description", ctypes.c_char * 256),
    )


def _layer_version(library: pathlib.Path) -> str:
    """The Vulkan version of the layer."""
    count, properties = ctypes.c_uint32(1), _LayerProperties()
    try:
        enumerate_layers = ctypes.CDLL(str(library)).vkEnumerateInstanceLayerProperties
        enumerate_layers(ctypes.byref(count), ctypes.byref(properties))
    except (OSError, AttributeError) as error:
        raise Unavailable(str(error)) from error
    packed = properties.specification
    return f"{packed >> 22 & 0x7f}.{packed >> 12 & 0x3ff}.{packed & 0xfff}"
