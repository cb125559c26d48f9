"""Text exports by instruments of many makers, written after their layouts, with one profile."""

import numpy as np

COUNT = 64
STEP_UM = 0.5
X_UM = STEP_UM * np.arange(COUNT)
Z_UM = np.round(0.4 * np.sin(0.31 * np.arange(COUNT)) + 0.05 * np.cos(1.7 * np.arange(COUNT)), 5)
ROWS, COLUMNS = 9, 12
MAP_UM = np.round(0.3 * np.sin(np.arange(COLUMNS) + 0.4 * np.arange(ROWS)[:, None] ** 1.3), 4)


def _columns(*columns: object, sep: str = "\t", mark: str = ".", style: str = "{:.7g}") -> str:
    rows = zip(*(np.asarray(column).tolist() for column in columns), strict=True)
    return "".join(
        sep.join(style.format(cell).replace(".", mark) for cell in row) + "\n" for row in rows
    )


def _matrix(sep: str = ",", mark: str = ".", factor: float = 1.0, style: str = "{:.7g}") -> str:
    return _columns(*(factor * MAP_UM).T, sep=sep, mark=mark, style=style)


_X_MM, _I, _T = X_UM / 1e3, np.arange(1, COUNT + 1), 0.01 * np.arange(COUNT)
_ZERO, _ONE = np.zeros(COUNT), np.ones(COUNT)

PROFILES = {
    "mahr-marwin": "[Profil]\nMerkmal;R-Profil\nTaststrecke;5,6;mm\nx [mm];z [µm]\n"
    + _columns(_X_MM, Z_UM, sep=";", mark=","),
    "mahr-german-tabs": "MarSurf XR 20\nDatum:\t26.11.2026\nOperator:\tM.\nWeg [mm]\tHöhe [µm]\n"
    + _columns(_X_MM, Z_UM, mark=","),
    "hommel": "HOMMEL-ETAMIC T8000\nLt = 4.80 mm  Vt = 0.50 mm/s\nX/mm  Z/µm\n"
    + _columns(_X_MM, Z_UM, sep="  "),
    "jenoptik-csv": '"Messweg","Profil"\n"mm","µm"\n' + _columns(_X_MM, Z_UM, sep=","),
    "jenoptik-turbo": "Turbo Wave V7\nMesspunkt;Taststrecke [mm];P-Profil [µm]\n"
    + _columns(_I, _X_MM, Z_UM, sep=";", mark=","),
    "taylor-hobson-talymap": "# Form Talysurf\n# Profile length: 32 µm\nX (mm)\tZ (µm)\n"
    + _columns(_X_MM, Z_UM),
    "taylor-hobson-ultra": "Ultra Surface Export\nUnits,mm,um\nX,Z\nmm,um\n"
    + _columns(_X_MM, Z_UM, sep=","),
    "mitutoyo-sj": "Model,SJ-410\nCut-off,0.8,mm\nN,5\nPitch,0.5,um\nUnit,um\nPROFILE\n"
    + _columns(Z_UM),
    "mitutoyo-formtracepak": "X [mm],Z [µm]\n" + _columns(_X_MM, Z_UM, sep=","),
    "mitutoyo-japanese": "測定条件\n測定速度,0.5mm/s\nX(mm),Z(μm)\n"
    + _columns(_X_MM, Z_UM, sep=","),
    "kosaka": "サンプリング間隔=0.5 μm\n単位=μm\n" + _columns(Z_UM),
    "tokyo-seimitsu": "SURFCOM\n位置(mm)\t高さ(μm)\n" + _columns(_X_MM, Z_UM),
    "keyence-profile": '"Distance","Height"\n"um","um"\n'
    + _columns(X_UM, Z_UM, sep=",", style='"{:.7g}"'),
    "keyence-points": "No.,Distance(um),Height(um)\n" + _columns(_I, X_UM, Z_UM, sep=","),
    "keyence-lj": "Profile No.,X [mm],Z [mm]\n" + _columns(_ONE, _X_MM, Z_UM / 1e3, sep=","),
    "dektak": "Meta Data\nSample,steel\nStylus,Radius: 2 um\n\nScan Data\n\n"
    "Lateral um,Raw Micrometer,\n" + _columns(X_UM, Z_UM, sep=",").replace("\n", ",\n"),
    "dektak-xt": "Lateral(µm),Total Profile(Å),,,\n"
    + _columns(X_UM, 1e4 * Z_UM, sep=",").replace("\n", ",,,\n"),
    "kla-alpha-step": "Scan Length: 32 um\nX (um)  Z (nm)\n"
    + _columns(X_UM, 1e3 * Z_UM, sep="   "),
    "kla-p7": "Position (micron)\tHeight (Å)\n" + _columns(X_UM, 1e4 * Z_UM),
    "zygo-profile": "Distance (mm), Height (µm)\n" + _columns(_X_MM, Z_UM, sep=", "),
    "zygo-mx": "Slice;Distance mm;Height nm\n" + _columns(_ONE, _X_MM, 1e3 * Z_UM, sep=";"),
    "bruker-vision": "X mm\tZ um\n" + _columns(_X_MM, Z_UM),
    "bruker-nanoscope": "Distance(um)\tHeight(nm)\n" + _columns(X_UM, 1e3 * Z_UM),
    "alicona": "Profile Path Length L [µm];Depth Z [µm]\n" + _columns(X_UM, Z_UM, sep=";"),
    "alicona-german": "Pfadlänge [µm];Tiefe Z [µm]\n" + _columns(X_UM, Z_UM, sep=";", mark=","),
    "sensofar": "SensoSCAN profile\nLength (µm);Height (µm)\n" + _columns(X_UM, Z_UM, sep=";"),
    "sensofar-french": "Longueur (µm);Hauteur (µm)\n" + _columns(X_UM, Z_UM, sep=";", mark=","),
    "mountains-french": "Nom;Profil 1\nPas;0,5;µm\nAbscisse (mm);Ordonnée (µm)\n"
    + _columns(_X_MM, Z_UM, sep=";", mark=","),
    "mountains-tabs": "Studiable: Profile\nX\tZ\nmm\tµm\n" + _columns(_X_MM, Z_UM),
    "gwyddion-profile": "       x          y\n     [m]        [m]\n"
    + _columns(1e-6 * X_UM, 1e-6 * Z_UM, sep="  ", style="{:.8e}"),
    "spip": "# Profile\n# X [nm]\tZ [nm]\n" + _columns(1e3 * X_UM, 1e3 * Z_UM),
    "nanofocus": "x[mm];z[µm];Intensität\n" + _columns(_X_MM, Z_UM, 100 + _I, sep=";", mark=","),
    "frt": "Zeit [s];Weg [mm];Höhe [µm];Intensität [%]\n"
    + _columns(_T, _X_MM, Z_UM, 50 * _ONE, sep=";", mark=","),
    "micro-epsilon": "Zeitstempel;X [mm];Z [mm];Intensity\n"
    + _columns(_T, _X_MM, Z_UM / 1e3, _ONE, sep=";"),
    "gelsight": "x_mm,z_mm\n" + _columns(_X_MM, Z_UM / 1e3, sep=","),
    "confovis": "Position / µm\tHöhe / µm\n" + _columns(X_UM, Z_UM, mark=","),
    "olympus-lext": '"Position[um]","Height[um]"\n' + _columns(X_UM, Z_UM, sep=","),
    "olympus-german": "Position [µm];Höhe [µm]\n" + _columns(X_UM, Z_UM, sep=";", mark=","),
    "leica": "Index;Position (mm);Höhe (µm)\n" + _columns(_I, _X_MM, Z_UM, sep=";", mark=","),
    "bmt": "Messpunkte: 64\nX-Position [mm];Höhenwert [µm];Gültig\n"
    + _columns(_X_MM, Z_UM, _ONE, sep=";"),
    "ambios": "XP-2\nX(mm),Z(µm)\n" + _columns(_X_MM, Z_UM, sep=","),
    "time-tr": "Spacing 0.5 um\nUnit: um\nData:\n" + _columns(Z_UM),
    "starrett": "Sampling interval: 0.0005 mm\nVertical units: um\n" + _columns(Z_UM, sep=";"),
    "accretech": "Pitch[um],0.5\nZ Unit,um\nDATA\n" + _columns(Z_UM),
    "insize": "Step: 0,5 µm\nZ [µm]\n" + _columns(Z_UM, mark=","),
    "hfm": "X;Y;valid\n[mm];[mm];[1/0]\n" + _columns(_X_MM, Z_UM / 1e3, _ONE, sep=";"),
    "y-constant": "X [mm];Y [mm];Z [µm]\n" + _columns(_X_MM, 3 * _ONE, Z_UM, sep=";"),
    "pandas": ",x_um,z_um\n" + _columns(_I - 1, X_UM, Z_UM, sep=","),
    "matlab": "% x (um)  z (um)\n" + _columns(X_UM, Z_UM, sep="  ", style="{:.9e}"),
    "fortran": "# x_um z_um\n" + _columns(X_UM, Z_UM, sep=" ", style="{:.9e}").replace("e", "D"),
    "origin": "Weg\tProfil\nmm\tµm\nSpur 1\tSpur 1\n" + _columns(_X_MM, Z_UM, mark=","),
    "italian": "Distanza [mm];Altezza [µm]\n" + _columns(_X_MM, Z_UM, sep=";", mark=","),
    "spanish": "Distancia (mm);Altura (µm);Fuerza (mN)\n"
    + _columns(_X_MM, Z_UM, _ONE, sep=";", mark=","),
    "footer": "x [mm];z [µm]\n" + _columns(_X_MM, Z_UM, sep=";") + "\nRa;0,28;µm\nRz;0,88;µm\n",
    "order": "Height [nm];Time [ms];Position [µm]\n" + _columns(1e3 * Z_UM, 10 * _T, X_UM, sep=";"),
}
"""Texts by their makers; each states units and steps, and is to be read without a question."""

_LANGUAGES = {
    "chinese": "时间(s);距离(mm);轮廓高度(μm)",
    "czech": "Čas [s];Délka [mm];Výška [µm]",
    "danish": "Tid [s];Strækning [mm];Højde [µm]",
    "dutch": "Tijd [s];Afstand [mm];Hoogte [µm]",
    "finnish": "Aika [s];Matka [mm];Korkeus [µm]",
    "hungarian": "Idő [s];Távolság [mm];Magasság [µm]",
    "korean": "번호;거리(mm);높이(µm)",
    "polish": "Czas;Droga [mm];Wysokość [µm]",
    "portuguese": "Tempo (s);Distância (mm);Altura (µm)",
    "russian": "Время [сек];Длина [мм];Высота [мкм]",
    "swedish": "Tid [s];Sträcka [mm];Höjd [µm]",
    "turkish": "Zaman [s];Mesafe [mm];Yükseklik [µm]",
}
PROFILES |= {
    name: f"{heading}\n" + _columns(_T, _X_MM, Z_UM, sep=";", mark=",")
    for name, heading in _LANGUAGES.items()
}

MAPS = {
    "keyence-vk": '"XY Calibration","0.500","um"\n"Unit","um"\n"Height"\n'
    + _matrix(style='"{:.7g}"'),
    "gwyddion": f"# Channel: Height\n# Width: {COLUMNS / 2} µm\n# Height: {ROWS / 2} µm\n"
    "# Value units: nm\n" + _matrix("\t", factor=1e3),
    "gwyddion-german": f"# Kanal: Höhe\n# Breite: {COLUMNS / 2} µm\n# Höhe: {ROWS / 2} µm\n"
    "# Einheiten: nm\n" + _matrix("\t", factor=1e3),
    "grid": "X [µm];Y [µm];Z [µm]\n"
    + _columns(
        np.tile(np.arange(COLUMNS) / 2, ROWS),
        np.repeat(np.arange(ROWS) / 2, COLUMNS),
        MAP_UM.ravel(),
        sep=";",
    ),
    "grid-with-intensity": "x_um,y_um,z_um,intensity\n"
    + _columns(
        np.tile(np.arange(COLUMNS) / 2, ROWS),
        np.repeat(np.arange(ROWS) / 2, COLUMNS),
        MAP_UM.ravel(),
        np.ones(ROWS * COLUMNS),
        sep=",",
    ),
    "pixel-size": "Pixel size: 0.5 µm\nHeight unit: µm\n" + _matrix(";", ","),
    "sampling": "Sampling step X (µm)\t0.5\nZ unit\tµm\n" + _matrix("\t"),
}
