# names in other letters
"""Names of the columns depth, force and time, in the languages of those who make and use testing machines."""

import re
import unicodedata

# What a column is called, without accents, spaces and the words that may stand beside it.
_NAMES = {
    "depth": """depth displacement disp displ position pos extension ext travel stroke crosshead insertion penetration
        distance dist deflection indentation elongation compression pd x y z lvdt encoder extensometer
        weg hub tiefe verschiebung eindringung
        deplacement profondeur course allongement enfoncement
        recorrido desplazamiento profundidad posicion alargamiento carrera distancia
        penetracion deslocamento profundidade
        spostamento profondita posizione corsa allungamento distanza penetrazione estensione
        変位 深さ 位置 伸び 距離 ストローク 変位量 押込み量 押し込み量
        位移 深度 行程 伸长 距离 변위 перемещение глубина""",
    "force": """force load f fx fy fz fn weight
        kraft last gewicht
        charge effort poids
        fuerza carga forca peso
        forza carico
        力 荷重 載荷 载荷 荷载 负荷 負荷 推力 하중 сила нагрузка усилие""",
    "time": """time times t elapsed timestamp stamp clock datetime xvalue
        zeit uhrzeit laufzeit
        temps heure duree
        tiempo hora
        tempo ora
        時間 時刻 经过时间 时间 时刻 시간 время""",
}
# Words that may stand beside a name and do not change what it is. Short ones only as whole words.
_PARTS = """standard estandar axial axiale axialer assiale assial normal normale needle insertion penetration puncture
    indentation compressive compression crosshead actuator primary frame machine test elapsed total running measured
    actual current unix epoch absolute relative corrected filtered probe sensor cell gauge channel contact stamp
    applied grip nadel traversen traverse kolben pruf pruef mess eindring einstich einstech druck maschinen
    versuchs verstrichene essai aiguille ecoule ecoulee appliquee
    aguja ensayo prueba transcurrido cabezal cruceta celda
    prova traversa trascorso applicata cella
    試験 経過 クロスヘッド 圧縮 押込み 押し込み 挿入 穿刺
    值 値 试验 试驗 試驗 测试 測試 实验 经过 经历 运行 轴向 针 插入 压缩 横梁 采样 标准 標準"""
_SHORT = """c tip tcp ee ft fts robot raw run ch of the in wrench pose header value values data field
    specimen probekorper eprouvette probeta provino
    de d du des la le del da di dell della do et 針 の"""
_WORDS = set(_SHORT.split())
_PART = re.compile("|".join(sorted(map(re.escape, _PARTS.split()), key=len, reverse=True)))
_ROLES = {word: role for role, words in _NAMES.items() for word in words.split()}
_ACCENTS = re.compile("[\u0300-\u036f]")


def _words(name: str) -> list[str]:
    """The words of a name in small letters, without accents, remarks in brackets and numbers."""
    text = re.sub(r"[\[({<].*?[\])}>]", " ", unicodedata.normalize("NFKC", name))
    text = _ACCENTS.sub("", unicodedata.normalize("NFD", re.sub(r"([a-z])([A-Z])", r"\1 \2", text)))
    return re.findall(r"[^\W\d_]+", unicodedata.normalize("NFC", text).casefold().replace("ß", "ss"))


def plain_name(name: str) -> str:
    """The words of a name in one: small letters without accents. `Axial Force` is axialforce."""
    return "".join(_words(name))


def role_named(name: str) -> str:
    """Which column this is by its name without the unit: depth, force, time, or empty.

    `Axial Displacement`, `Prüfkraft`, `Temps d'essai` and `試験力` are known by the word that is left without those
    that say which depth, force or time it is.
    """
    words = _words(name)
    whole = "".join(words)
    if whole in _ROLES:
        return _ROLES[whole]
    kept = [word for word in words if word not in _WORDS]
    left = [part for word in kept if (part := _PART.sub("", word)) and part not in "xyz"]
    for word in ("".join(left), "".join(kept)):
        if word in _ROLES:
            return _ROLES[word]
    roles = {_ROLES.get(word, "") for word in left}  # `Kraft F`
    return roles.pop() if len(roles) == 1 else ""
