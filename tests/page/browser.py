"""Headless Chromium, driven over the DevTools protocol."""

import base64
import io
import json
import os
import shutil
import signal
import subprocess
import tempfile
import time

import websocket
from PIL import Image

FLAGS = [
    "--headless", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
    "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync",
    "--disable-extensions", "--disable-default-apps", "--mute-audio", "--hide-scrollbars", "--force-device-scale-factor=1",
    "--password-store=basic", "--disable-dev-shm-usage", "--remote-debugging-port=0", "--remote-allow-origins=*",
]
KEY_CODES = {"Tab": 9, "Enter": 13, "Escape": 27, " ": 32, "PageUp": 33, "PageDown": 34, "End": 35, "Home": 36,
             "ArrowLeft": 37, "ArrowUp": 38, "ArrowRight": 39, "ArrowDown": 40}


def program():
    """Path of Chromium, or None."""
    return shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")


class Browser:
    """One Chromium process; a context manager."""

    def __init__(self, flags=(), size=(1200, 800)):
        self.folder = tempfile.mkdtemp(prefix="asdfvk-browser-")
        window = f"--window-size={size[0]},{size[1]}"
        command = [program(), *FLAGS, *flags, window, f"--user-data-dir={self.folder}", "about:blank"]
        self.process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                        start_new_session=True)
        self.port = self._port()

    def _port(self, seconds=30):
        path = os.path.join(self.folder, "DevToolsActivePort")
        end = time.monotonic() + seconds
        while time.monotonic() < end and self.process.poll() is None:
            if os.path.exists(path):
                with open(path) as file:
                    lines = file.read().split("\n")
                if len(lines) > 1:
                    self.path = lines[1]
                    return int(lines[0])
            time.sleep(0.02)
        raise RuntimeError("Chromium did not start")

    def page(self, address=None, **settings):
        browser = Socket(f"ws://127.0.0.1:{self.port}{self.path}")
        target = browser.call("Target.createTarget", url="about:blank")["targetId"]
        browser.socket.close()
        page = Page(f"ws://127.0.0.1:{self.port}/devtools/page/{target}", self.folder)
        page.prepare(**settings)
        if address:
            page.open(address)
        return page

    def __enter__(self):
        return self

    def __exit__(self, *_):
        os.killpg(self.process.pid, signal.SIGKILL)
        self.process.wait()
        shutil.rmtree(self.folder, ignore_errors=True)


class Socket:
    """Calls and events of one target."""

    def __init__(self, address):
        self.socket = websocket.create_connection(address, timeout=60, suppress_origin=True)
        self.count = 0
        self.events = []

    def call(self, method, **parameters):
        self.count += 1
        self.socket.send(json.dumps({"id": self.count, "method": method, "params": parameters}))
        while True:
            message = json.loads(self.socket.recv())
            if message.get("id") != self.count:
                self.events.append(message)
            elif "error" in message:
                raise RuntimeError(f"{method}: {message['error']['message']}")
            else:
                return message["result"]


class Page(Socket):
    def __init__(self, address, folder):
        super().__init__(address)
        self.folder = folder

    def prepare(self, size=None, dark=False, before=None):
        for domain in ("Page", "Runtime", "Network", "Log"):
            self.call(f"{domain}.enable")
        features = [{"name": "prefers-color-scheme", "value": "dark" if dark else "light"},
                    {"name": "prefers-reduced-motion", "value": "reduce"}]
        self.call("Emulation.setEmulatedMedia", features=features)
        if size:
            self.call("Emulation.setDeviceMetricsOverride", width=size[0], height=size[1], deviceScaleFactor=1, mobile=False)
        if before:
            self.call("Page.addScriptToEvaluateOnNewDocument", source=before)

    def open(self, address, state="ready", seconds=30):
        self.call("Page.navigate", url=address)
        self.wait(f"document.documentElement?.dataset.state === '{state}'"
                  + (" && document.documentElement.dataset.frames > 0" if state == "ready" else ""), seconds)

    def js(self, expression):
        result = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in result:
            raise RuntimeError(f"{expression}: {result['exceptionDetails']['exception'].get('description')}")
        return result["result"].get("value")

    def wait(self, condition, seconds=10):
        """Waits until the expression is true."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            if self.js(condition):
                return
            time.sleep(0.02)
        state = self.js("document.documentElement.dataset.state + ': ' + document.getElementById('message')?.textContent")
        raise AssertionError(f"still not true after {seconds} s: {condition} (state {state})")

    def frames(self):
        return int(self.js("document.documentElement.dataset.frames ?? 0"))

    def settle(self):
        """Waits until the view is still, in full quality."""
        self.js("""new Promise((done) => {
          let count = 0;
          const look = () => {
            count = document.documentElement.dataset.still === 'true' ? count + 1 : 0;
            if (count > 1) done();
            else requestAnimationFrame(look);
          };
          requestAnimationFrame(look);
        })""")

    def mouse(self, kind, x, y, button="left", buttons=None, **more):
        self.call("Input.dispatchMouseEvent", type=kind, x=float(x), y=float(y), button=button,
                  buttons=(1 if button == "left" else 2) if buttons is None else buttons, **more)

    def click(self, x, y, count=1):
        self.mouse("mousePressed", x, y, clickCount=count)
        self.mouse("mouseReleased", x, y, clickCount=count, buttons=0)

    def drag(self, start, end, button="left", steps=4):
        self.mouse("mousePressed", *start, button=button, clickCount=1)
        for i in range(1, steps + 1):
            self.mouse("mouseMoved", *(a + (b - a) * i / steps for a, b in zip(start, end)), button=button)
        self.mouse("mouseReleased", *end, button=button, buttons=0, clickCount=1)

    def key(self, key, shift=False):
        text = {"Enter": "\r", " ": " "}.get(key, key if len(key) == 1 else None)
        code = KEY_CODES.get(key, ord(key[0].upper()))
        modifiers = 8 if shift else 0
        common = dict(key=key, code=key, windowsVirtualKeyCode=code, modifiers=modifiers)
        self.call("Input.dispatchKeyEvent", type="keyDown" if text else "rawKeyDown", **common, **({"text": text} if text else {}))
        self.call("Input.dispatchKeyEvent", type="keyUp", **common)

    def screenshot(self, path=None, area=None):
        """The window, or an area (left, top, width, height) of it, as an image of PIL; also written to `path`."""
        clip = {"clip": dict(zip(("x", "y", "width", "height"), map(float, area)), scale=1)} if area is not None else {}
        data = base64.b64decode(self.call("Page.captureScreenshot", format="png", optimizeForSpeed=True, **clip)["data"])
        if path:
            with open(path, "wb") as file:
                file.write(data)
        return Image.open(io.BytesIO(data)).convert("RGB")

    def choose(self, element, value):
        """Sets a form element as a user does."""
        self.js(f"""(() => {{
          const element = document.getElementById({json.dumps(element)});
          if (element.type === 'checkbox') element.checked = {json.dumps(value)};
          else element.value = {json.dumps(value)};
          element.dispatchEvent(new Event('input', {{bubbles: true}}));
          element.dispatchEvent(new Event('change', {{bubbles: true}}));
        }})()""")

    def text(self, element):
        return self.js(f"document.getElementById({json.dumps(element)})?.textContent")

    def messages(self):
        """Console messages, exceptions and log entries, but not the stalls that reading pixels always reports."""
        self.js("0")
        found = []
        for event in self.events:
            if event["method"] == "Runtime.consoleAPICalled":
                found.append(" ".join(str(a.get("value", a.get("description"))) for a in event["params"]["args"]))
            elif event["method"] == "Runtime.exceptionThrown":
                found.append(str(event["params"]["exceptionDetails"].get("exception", {}).get("description")))
            elif event["method"] == "Log.entryAdded":
                found.append(event["params"]["entry"]["text"])
        return [text for text in found if "GPU stall due to ReadPixels" not in text]

    def requests(self):
        """Addresses that the page requested, apart from itself and from data and blobs inside of it."""
        self.js("0")
        sent = [e["params"]["request"]["url"] for e in self.events if e["method"] == "Network.requestWillBeSent"]
        return [url for url in sent[1:] if not url.startswith(("data:", "blob:"))]
