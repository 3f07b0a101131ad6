"""Masking noise: without it, a participant hears the device's motors."""

import io
import wave

import numpy as np

RATE, LOWEST, HIGHEST = 44_100, 20.0, 16_000.0  # Hz


def pink_noise(seconds: int, seed: int = 0) -> bytes:
    """A WAV file of noise with as much power in each octave. Its end fits to its beginning: it can play in a loop."""
    count = seconds * RATE
    hertz = np.fft.rfftfreq(count, 1 / RATE)
    size = np.where((hertz >= LOWEST) & (hertz <= HIGHEST), 1 / np.sqrt(np.maximum(hertz, LOWEST)), 0.0)
    turns = np.random.default_rng(seed).random(len(hertz))
    sound = np.fft.irfft(size * np.exp(2j * np.pi * turns), count)
    data = io.BytesIO()
    with wave.open(data, "wb") as file:
        file.setparams((1, 2, RATE, 0, "NONE", ""))
        file.writeframes((sound / np.abs(sound).max() * 32_767).astype("<i2").tobytes())
    return data.getvalue()
