// A program in C# on the shared library, by P/Invoke: values.bin of MESH, which run.cmake compares with that of the
// program.
//   mono Consumer.exe MESH
using System;
using System.IO;
using System.Runtime.InteropServices;

static class AsdfVk
{
    const string Library = "asdf-vk-c";
    public delegate int Progress(double fraction, IntPtr stage, IntPtr user);
    [DllImport(Library)] public static extern int asdf_vk_abi();
    [DllImport(Library)] public static extern IntPtr asdf_vk_last_error();
    [DllImport(Library)] public static extern int asdf_vk_options_create(out IntPtr options);
    [DllImport(Library)] public static extern int asdf_vk_options_set(IntPtr options, string name, string value);
    [DllImport(Library)] public static extern void asdf_vk_options_destroy(IntPtr options);
    [DllImport(Library)] public static extern int asdf_vk_session_create(IntPtr options, out IntPtr session);
    [DllImport(Library)] public static extern void asdf_vk_session_destroy(IntPtr session);
    [DllImport(Library)] public static extern int asdf_vk_scene_create(IntPtr session, double[] vertices,
        int vertexType, UIntPtr vertexCount, int[] corners, int cornerType, UIntPtr faceCount, string unit,
        out IntPtr scene);
    [DllImport(Library)] public static extern int asdf_vk_scene_read(IntPtr session, string path, out IntPtr scene);
    [DllImport(Library)] public static extern void asdf_vk_scene_destroy(IntPtr scene);
    [DllImport(Library)] public static extern int asdf_vk_compute(IntPtr scene, IntPtr options, Progress progress,
        IntPtr user, out IntPtr result);
    [DllImport(Library)] public static extern int asdf_vk_result_copy(IntPtr result, string name, int location,
        int type, float[] numbers, UIntPtr capacity);
    [DllImport(Library)] public static extern int asdf_vk_result_json(IntPtr result, string pointer, out IntPtr json);
    [DllImport(Library)] public static extern void asdf_vk_result_destroy(IntPtr result);

    public static void Check(int status)
    {
        if (status != 0) throw new Exception(status + ": " + Marshal.PtrToStringAnsi(asdf_vk_last_error()));
    }
}

static class Consumer
{
    const int Float64 = 0, Float32 = 1, Int32 = 4, PerFace = 0, Usage = 1, Cancelled = 130;

    static void Require(bool condition, string what)
    {
        if (!condition) throw new Exception(what);
    }

    static float[] Values(IntPtr result, int count)
    {
        var values = new float[count];
        AsdfVk.Check(AsdfVk.asdf_vk_result_copy(result, "sdf", PerFace, Float32, values, (UIntPtr)count));
        return values;
    }

    static int Main(string[] arguments)
    {
        IntPtr options, session, scene, result, json;
        Require(AsdfVk.asdf_vk_abi() == 1, "abi");
        AsdfVk.Check(AsdfVk.asdf_vk_options_create(out options));
        AsdfVk.Check(AsdfVk.asdf_vk_options_set(options, "backend", "cpu"));
        AsdfVk.Check(AsdfVk.asdf_vk_session_create(options, out session));
        AsdfVk.Check(AsdfVk.asdf_vk_options_set(options, "backend", null));
        Require(AsdfVk.asdf_vk_options_set(options, "rays", "0") == Usage, "rays");
        Require(Marshal.PtrToStringAnsi(AsdfVk.asdf_vk_last_error())
            == "rays: '0' is not a whole number from 1 to 1024", "the message");

        // A tetrahedron in arrays.
        var vertices = new double[] { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1 };
        var corners = new int[] { 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3 };
        AsdfVk.Check(AsdfVk.asdf_vk_scene_create(session, vertices, Float64, (UIntPtr)4, corners, Int32, (UIntPtr)4,
            null, out scene));
        AsdfVk.Check(AsdfVk.asdf_vk_compute(scene, IntPtr.Zero, null, IntPtr.Zero, out result));
        Require(Values(result, 4)[0] > 0, "a value");
        AsdfVk.asdf_vk_result_destroy(result);
        AsdfVk.asdf_vk_scene_destroy(scene);

        // A file, with progress.
        int calls = 0;
        AsdfVk.Progress count = (fraction, stage, user) => { ++calls; return 0; };
        AsdfVk.Progress stop = (fraction, stage, user) => 1;
        AsdfVk.Check(AsdfVk.asdf_vk_options_set(options, "seeds", "20%"));
        AsdfVk.Check(AsdfVk.asdf_vk_scene_read(session, arguments[0], out scene));
        Require(AsdfVk.asdf_vk_compute(scene, options, stop, IntPtr.Zero, out result) == Cancelled, "cancelled");
        AsdfVk.Check(AsdfVk.asdf_vk_compute(scene, options, count, IntPtr.Zero, out result));
        GC.KeepAlive(count);
        Require(calls > 3, "progress");
        AsdfVk.Check(AsdfVk.asdf_vk_result_json(result, "/faceCount", out json));
        var values = Values(result, int.Parse(Marshal.PtrToStringAnsi(json)));
        using (var writer = new BinaryWriter(File.Create("values.bin")))
            foreach (float value in values) writer.Write(value);
        AsdfVk.asdf_vk_session_destroy(session);
        AsdfVk.asdf_vk_scene_destroy(scene);
        AsdfVk.asdf_vk_result_destroy(result);
        AsdfVk.asdf_vk_options_destroy(options);
        return 0;
    }
}
