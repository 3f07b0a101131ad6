// Never run in Unity: a membrane in a Unity scene. Its surface is the plane of the transform; the needle enters against
// the transform's up.
using UnityEngine;

namespace Punctura
{
    public sealed class PuncturaMembrane : MonoBehaviour
    {
        [Tooltip("kappa, N/mm")] public float stiffness = 0.57f;
        [Tooltip("c, N")] public float precompression = 0.41f;
        [Tooltip("mu")] public float friction = 0.2f;
        [Tooltip("H, mm")] public float thickness = 1f;

        internal MembraneSettings Settings()
        {
            return new MembraneSettings
            {
                Name = name,
                Stiffness = stiffness * 1e3,
                Precompression = precompression,
                Friction = friction,
                Thickness = thickness * 1e-3,
                Point = Axes.ToPunctura(transform.position),
                InwardNormal = Axes.ToPunctura(-transform.up),
            };
        }
    }

    /// <summary>Unity is left-handed and Punctura right-handed: z changes its sign. Both use metres.</summary>
    internal static class Axes
    {
        internal static Triple ToPunctura(Vector3 v) { return new Triple(v.x, v.y, -v.z); }
        internal static Vector3 ToUnity(Triple t) { return new Vector3((float)t.X, (float)t.Y, (float)-t.Z); }
    }
}
