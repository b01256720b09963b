import numpy as np
import pytest

from gltf_files import CUBE, CUBE_FACES, Gltf, written
from shapewright.references.errors import UnreadableError
from shapewright.references.readers.formats import read
from shapewright.references.readers.gltf.meshopt import decoded


def zigzag(deltas: np.ndarray, bits: int) -> np.ndarray:
    signed = deltas.astype(f"i{bits // 8}")
    return ((signed << 1) ^ (signed >> (bits - 1))).astype(f"u{bits // 8}")


def group(deltas: np.ndarray, bits: int) -> bytes:
    """Sixteen deltas in a code of some bits each, with those that do not fit behind it."""
    if bits == 8:
        return deltas.tobytes()
    sentinel = (1 << bits) - 1
    codes = np.minimum(deltas, sentinel)
    in_bytes = codes.reshape(-1, 8 // bits)
    shifts = np.arange(8 // bits) * bits
    packed = (in_bytes << (shifts if bits == 1 else shifts[::-1])).sum(axis=1).astype(np.uint8)
    return packed.tobytes() + deltas[codes == sentinel].tobytes()


def attributes(elements: np.ndarray, channel=0, seed: int | None = None) -> bytes:
    """A stream of elements (N, stride) of bytes: version 0 without a seed, else version 1, all modes at random."""
    stride = elements.shape[1]
    version = seed is not None
    rng = np.random.default_rng(seed or 0)
    before = np.concatenate([elements[:1], elements[:-1]])
    if channel == 0:
        deltas = zigzag(elements - before, 8)
    elif channel == 1:
        deltas = zigzag(elements.view("<u2") - before.view("<u2"), 16).view(np.uint8)
    else:
        turn = channel >> 4
        words = elements.view("<u4") ^ before.view("<u4")
        deltas = (
            ((words << turn) | (words >> (32 - turn if turn else 0) if turn else words)).astype("<u4").view(np.uint8)
        )
    most = min((8192 // stride) & ~15, 256)
    stream = bytes([0xA0 + version])
    for first in range(0, len(elements), most):
        block = deltas[first : first + most]
        groups = -(-len(block) // 16)
        padded = np.zeros((16 * groups, stride), np.uint8)
        padded[: len(block)] = block
        controls = rng.choice([0, 1, 3], stride)
        controls[~padded.any(axis=0)] = 2
        if version:
            stream += (controls.reshape(-1, 4) << [0, 2, 4, 6]).sum(axis=1).astype(np.uint8).tobytes()
        for byte in range(stride):
            control, column = controls[byte], padded[:, byte].reshape(-1, 16)
            if version and control == 2:
                continue
            if version and control == 3:
                stream += block[:, byte].tobytes()
                continue
            bits = ([0, 1, 2, 4], [1, 2, 4, 8])[control] if version else [0, 2, 4, 8]
            modes = np.array([rng.integers(1 if part.any() else 0, 4) for part in column])
            header = np.zeros(-(-groups // 4) * 4, np.int64)
            header[:groups] = modes
            stream += (header.reshape(-1, 4) << [0, 2, 4, 6]).sum(axis=1).astype(np.uint8).tobytes()
            stream += b"".join(group(part, bits[mode]) for part, mode in zip(column, modes, strict=True) if bits[mode])
    tail = elements[0].tobytes() + (bytes([channel]) * (stride // 4) if version else b"")
    return stream + bytes(max((24 if version else 32) - len(tail), 0)) + tail


def told(number: int) -> bytes:
    """A number in bytes of seven bits."""
    result = b""
    while number > 127:
        result += bytes([number & 127 | 128])
        number >>= 7
    return result + bytes([number])


def triangles(indices) -> bytes:
    """A stream in which every corner is told as a difference to the last one."""
    codes, data, last = b"", b"", 0
    for i, index in enumerate(indices):
        if i % 3 == 0:
            codes, data = codes + b"\xff", data + b"\xff"
        delta = int(index) - last
        data += told((delta << 1) ^ (delta >> 31))
        last = int(index)
    return b"\xe1" + codes + data + bytes(16)


def decode(stream: bytes, count: int, stride: int, mode: str, name: str = "NONE") -> bytes:
    return bytes(decoded(memoryview(stream), count, stride, mode, name))


def reason(*arguments) -> str:
    with pytest.raises(UnreadableError) as error:
        decode(*arguments)
    return str(error.value)


class TestAttributes:
    @pytest.mark.parametrize("stride", [4, 12, 64, 256])
    @pytest.mark.parametrize("count", [1, 16, 100, 600])
    @pytest.mark.parametrize(("channel", "seed"), [(0, None), (0, 1), (0, 2), (1, 3), (2, 4), (0x52, 5), (0xF2, 6)])
    def test_every_code_gives_the_elements_back(self, count, stride, channel, seed):
        rng = np.random.default_rng(count)
        steps = rng.integers(-3, 4, (count, stride)) + (rng.random((count, stride)) < 0.1) * rng.integers(0, 256)
        steps[:, stride // 2 :] = 0
        elements = np.cumsum(steps, axis=0).astype(np.uint8)
        assert decode(attributes(elements, channel, seed), count, stride, "ATTRIBUTES") == elements.tobytes()

    def test_the_example_of_the_format(self):
        codes = bytes.fromhex("175ff0bc77a9210034b5")
        deltas = [-1, -4, -3, 26, -91, 0, -6, 6, -4, -4, 5, -5, 1, -1, 0, 0]
        stream = b"\xa0" + b"\2" + codes + b"\0\0\0" + bytes(32)
        found = np.frombuffer(decode(stream, 16, 4, "ATTRIBUTES"), np.int8).reshape(16, 4)
        np.testing.assert_array_equal(found[:, 0], np.cumsum(deltas).astype(np.int8))
        assert not found[:, 1:].any()

    def test_a_stream_that_ends_early_or_is_not_used_up_is_refused(self):
        elements = np.random.default_rng(0).integers(0, 256, (40, 8)).astype(np.uint8)
        for seed in (None, 1):
            stream = attributes(elements, seed=seed)
            assert "is not used up" in reason(stream[:1] + stream, 40, 8, "ATTRIBUTES")
            for length in range(len(stream)):
                assert "meshopt stream" in reason(stream[:length], 40, 8, "ATTRIBUTES")

    @pytest.mark.parametrize("channel", [3, 0x10, 0x21])
    def test_channels_that_are_not_known_are_refused(self, channel):
        stream = attributes(np.zeros((4, 4), np.uint8), seed=1)
        assert "channels that are not known" in reason(stream[:-1] + bytes([channel]), 4, 4, "ATTRIBUTES")


class TestTriangles:
    @pytest.mark.parametrize(("stride", "kind"), [(2, "<u2"), (4, "<u4")])
    def test_corners_that_are_told(self, stride, kind):
        indices = np.random.default_rng(0).integers(0, 60_000, 300)
        assert decode(triangles(indices), 300, stride, "TRIANGLES") == indices.astype(kind).tobytes()

    def test_corners_that_are_known_from_before(self):
        # New: 0 1 2. Edge 2 1 and a new one: 3. Edge 2 3 and an old one, the fourth last: 0. Edge and one before the
        # last that was told, 9 - 1, and one behind it. New, with the last, and the third last. Told, and all forgotten.
        codes = [0xF0, 0x10, 0x13, 0xFF, 0x0D, 0x0E, 0xF1, 0xFE]
        data = bytes([0xFF, *told(18), *told(0), *told(0), 0x00])
        stream = bytes([0xE1, *codes]) + data + bytes([0x00, 0x13, *bytes(14)])
        found = np.frombuffer(decode(stream, 24, 2, "TRIANGLES"), "<u2").reshape(-1, 3).tolist()
        assert found == [[0, 1, 2], [2, 1, 3], [3, 1, 0], [9, 9, 9], [9, 9, 8], [9, 8, 9], [4, 9, 9], [0, 1, 2]]

    def test_edges_and_corners_that_were_not_there_are_refused(self):
        for codes in ([0x00], [0xF0, 0x70], [0xF0, 0x14]):
            stream = bytes([0xE1, *codes]) + bytes(16)
            assert "code that is not valid" in reason(stream, 3 * len(codes), 2, "TRIANGLES")
        assert "code that is not valid" in reason(bytes([0xE1, 0xF0, 0x0F, *bytes(15)]), 3, 2, "TRIANGLES")

    def test_a_stream_that_ends_early_or_is_not_used_up_is_refused(self):
        stream = triangles(CUBE_FACES.reshape(-1))
        assert "is not used up" in reason(stream + b"\0", 36, 2, "TRIANGLES")
        for length in range(len(stream)):
            assert "meshopt stream" in reason(stream[:length], 36, 2, "TRIANGLES")
        assert "too short" in reason(stream, 3 * 10**9, 2, "TRIANGLES")

    def test_a_number_longer_than_32_bits_is_refused(self):
        stream = b"\xe1\xff\xff" + b"\x80" * 6 + bytes(16)
        assert "code that is not valid" in reason(stream, 3, 4, "TRIANGLES")


class TestIndices:
    def test_two_sequences_in_one(self):
        numbers = [(5, 0), (1000, 1), (6, 0), (999, 1), (4, 0)]
        last, data = [0, 0], b""
        for number, which in numbers:
            delta = number - last[which]
            data += told((((delta << 1) ^ (delta >> 31)) << 1) | which)
            last[which] = number
        found = decode(b"\xd1" + data + bytes(4), 5, 4, "INDICES")
        assert np.frombuffer(found, "<u4").tolist() == [number for number, _ in numbers]
        assert "is not used up" in reason(b"\xd1" + data + bytes(5), 5, 4, "INDICES")
        assert "ends early" in reason(b"\xd1" + data + bytes(3), 5, 4, "INDICES")


@pytest.mark.parametrize(
    ("stream", "count", "stride", "mode", "name", "why"),
    [
        (b"", 3, 4, "ATTRIBUTES", "NONE", "header that is not known"),
        (b"\xa2" + bytes(40), 3, 4, "ATTRIBUTES", "NONE", "header that is not known"),
        (b"\xe0" + bytes(40), 3, 4, "TRIANGLES", "NONE", "header that is not known"),
        (b"\xa0" + bytes(40), 3, 5, "ATTRIBUTES", "NONE", "of mode ATTRIBUTES, 5 bytes"),
        (b"\xa0" + bytes(40), 3, 260, "ATTRIBUTES", "NONE", "of mode ATTRIBUTES, 260 bytes"),
        (b"\xa0" + bytes(40), 3, 0, "ATTRIBUTES", "NONE", "of mode ATTRIBUTES, 0 bytes"),
        (b"\xe1" + bytes(40), 3, 8, "TRIANGLES", "NONE", "of mode TRIANGLES, 8 bytes"),
        (b"\xe1" + bytes(40), 3, 4, "TRIANGLES", "OCTAHEDRAL", "of mode TRIANGLES, 4 bytes, filter OCTAHEDRAL"),
        (b"\xe1" + bytes(40), 4, 4, "TRIANGLES", "NONE", "too short"),
        (b"\xe1" + bytes(40), 3, 4, "SPLINES", "NONE", "of mode SPLINES"),
        (b"\xa0" + bytes(36), 4, 4, "ATTRIBUTES", "SMOOTH", "filter SMOOTH"),
        (b"\xa0" + bytes(36), 4, 4, "ATTRIBUTES", "QUATERNION", "filter QUATERNION of elements of 4 bytes"),
    ],
)
def test_what_is_not_of_the_format_is_refused(stream, count, stride, mode, name, why):
    assert why in reason(stream, count, stride, mode, name)


class TestFiles:
    def gltf(self, extension: str, positions: np.ndarray, **more) -> Gltf:
        gltf = Gltf(extensionsRequired=[extension])
        streams = (
            (attributes(positions.view(np.uint8).reshape(8, -1)), 8, positions.itemsize * 4, "ATTRIBUTES", more),
            (triangles(CUBE_FACES.reshape(-1)), 36, 2, "TRIANGLES", {}),
        )
        views = []
        for stream, count, stride, mode, rest in streams:
            data = gltf.document["bufferViews"][gltf.view(stream)]
            compressed = {**data, "count": count, "byteStride": stride, "mode": mode, **rest}
            plain = {"buffer": 1, "byteLength": count * stride, "extensions": {extension: compressed}}
            gltf.document["bufferViews"].append(plain | ({"byteStride": stride} if mode == "ATTRIBUTES" else {}))
            views.append(len(gltf.document["bufferViews"]) - 1)
        gltf.document["buffers"] = [{"byteLength": 2**30}]
        position = gltf.accessor(8, "VEC3", positions.dtype.str[1:], bufferView=views[0])
        indices = gltf.accessor(36, "SCALAR", "u2", bufferView=views[1])
        return gltf.shown(gltf.mesh({"attributes": {"POSITION": position}, "indices": indices}))

    @pytest.mark.parametrize("extension", ["EXT_meshopt_compression", "KHR_meshopt_compression"])
    def test_a_compressed_mesh_is_read(self, tmp_path, extension):
        positions = np.pad(CUBE * [100, 200, 300], ((0, 0), (0, 1))).astype("<i2")
        mesh, notes = read(written(tmp_path, self.gltf(extension, positions)))
        np.testing.assert_array_equal(mesh.triangles, (CUBE * [100, 200, 300])[CUBE_FACES])
        assert notes == ()

    def test_a_filter_is_applied(self, tmp_path):
        exponents = np.pad((CUBE * 5).astype("<i4") | (1 << 24), ((0, 0), (0, 1)))
        gltf = self.gltf("EXT_meshopt_compression", exponents, filter="EXPONENTIAL")
        for accessor in gltf.document["accessors"]:
            accessor["componentType"] = {5124: 5126}.get(accessor["componentType"], accessor["componentType"])
        np.testing.assert_array_equal(read(written(tmp_path, gltf))[0].triangles, (CUBE * 10)[CUBE_FACES])

    def test_a_view_that_would_fill_the_memory_is_refused(self, tmp_path):
        gltf = self.gltf("EXT_meshopt_compression", np.zeros((8, 4), "<i2"), count=2**34)
        with pytest.raises(UnreadableError, match="too large to read"):
            read(written(tmp_path, gltf))
