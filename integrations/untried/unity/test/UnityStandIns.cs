// Stand-ins for the few classes of UnityEngine that the components use. They let the components compile and run without
// Unity; they are no copy of Unity's code.
using System;
using System.Collections.Generic;

namespace UnityEngine
{
    public struct Vector3
    {
        public float x, y, z;
        public Vector3(float x, float y, float z) { this.x = x; this.y = y; this.z = z; }
        public float magnitude { get { return (float)Math.Sqrt(x * x + y * y + z * z); } }
        public static Vector3 operator -(Vector3 v) { return new Vector3(-v.x, -v.y, -v.z); }
    }
    public struct Rect
    {
        public Rect(float x, float y, float width, float height) { }
    }
    public sealed class Transform
    {
        public Vector3 position, up = new Vector3(0, 1, 0), forward = new Vector3(0, 0, 1);
    }
    public class MonoBehaviour
    {
        public static readonly List<MonoBehaviour> All = new List<MonoBehaviour>();
        public string name = "object";
        public readonly Transform transform = new Transform();
        public MonoBehaviour() { All.Add(this); }
        protected static T[] FindObjectsOfType<T>() where T : MonoBehaviour
        {
            var found = new List<T>();
            foreach (var one in All)
                if (one is T) found.Add((T)one);
            return found.ToArray();
        }
    }
    public sealed class TextAsset
    {
        public string text;
    }
    public sealed class Rigidbody
    {
        public Vector3 force;
        public void AddForceAtPosition(Vector3 force, Vector3 position) { this.force = force; }
    }
    public static class Time
    {
        public static float fixedDeltaTime;
    }
    public static class GUI
    {
        public static string Shown;
        public static void Label(Rect place, string text) { Shown = text; }
    }
    [AttributeUsage(AttributeTargets.Field)]
    public sealed class TooltipAttribute : Attribute
    {
        public TooltipAttribute(string text) { }
    }
}
